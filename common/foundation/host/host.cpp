#include "inslab/foundation/host/host.hpp"

#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <random>
#include <sstream>
#include <string_view>

namespace inslab::host {

namespace {

time::Nanoseconds read_clock(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return time::Nanoseconds(static_cast<std::int64_t>(now.tv_sec) * time::kNsPerSecond + now.tv_nsec);
}

}  // namespace

time::Nanoseconds realtime_now() { return read_clock(CLOCK_REALTIME); }

time::Nanoseconds monotonic_now() { return read_clock(CLOCK_MONOTONIC); }

void sleep_until(time::Nanoseconds deadline) {
  // A plain absolute sleep wakes 70 to 120 us late here; ending it 80 us early and spinning the rest, 0.1 us.
  constexpr time::Nanoseconds kSpin(80'000);
  const std::int64_t wake = (deadline - kSpin).count();
  if (wake > monotonic_now().count()) {
    const timespec until{static_cast<time_t>(wake / time::kNsPerSecond), static_cast<long>(wake % time::kNsPerSecond)};
    if (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) return;
  }
  while (monotonic_now() < deadline) {
  }
}

void use_precise_timers() { prctl(PR_SET_TIMERSLACK, 1UL); }

std::uint64_t random_id() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

RunId random_run_id() {
  std::random_device device;
  RunId id;
  for (std::uint8_t& byte : id.bytes) byte = static_cast<std::uint8_t>(device());
  return id;
}

std::string run_id_text(const RunId& run_id) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : run_id.bytes) {
    text += kHex[byte >> 4];
    text += kHex[byte & 15];
  }
  return text;
}

std::optional<RunId> run_id_of(const std::string& text) {
  static constexpr std::string_view kHex = "0123456789abcdef";
  RunId run_id;
  if (text.size() != 2 * run_id.bytes.size()) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t digit = kHex.find(text[i]);
    if (digit == std::string_view::npos) return std::nullopt;
    run_id.bytes[i / 2] = static_cast<std::uint8_t>(run_id.bytes[i / 2] << 4 | digit);
  }
  return run_id;
}

std::string host_name() {
  char name[65] = {};
  gethostname(name, sizeof(name) - 1);
  return name;
}

std::uint32_t process_id() { return static_cast<std::uint32_t>(getpid()); }

std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total_pages = 0;
  std::uint64_t resident_pages = 0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::string process_space() {
  static const std::string space = [] {
    std::string boot;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
    char name[64] = {};
    const ssize_t length = readlink("/proc/self/ns/pid", name, sizeof(name) - 1);
    return boot.substr(0, 13) + " " + std::string(name, length < 0 ? 0 : static_cast<std::size_t>(length));
  }();
  return space;
}

std::optional<std::uint64_t> started_ticks(std::uint32_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text, '\0');
  // The second field, the name, may hold anything; what follows its last parenthesis counts from the third. man 5 proc.
  constexpr int kState = 3;
  constexpr int kStartTime = 22;
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  for (int number = kState; number <= kStartTime && fields >> field; ++number) {
    if (number == kState && (field == "Z" || field == "X")) return std::nullopt;
    if (number == kStartTime) return std::strtoull(field.c_str(), nullptr, 10);
  }
  return std::nullopt;
}

std::string cpu_features() {
#if defined(__x86_64__)
  std::string text = "x86-64";
  // The mathematics of the C library picks its code by these.
  if (__builtin_cpu_supports("avx2")) text += " avx2";
  if (__builtin_cpu_supports("fma")) text += " fma";
  if (__builtin_cpu_supports("avx512f")) text += " avx512f";
  return text;
#else
  return "other";
#endif
}

namespace {

std::string utc(time::Nanoseconds realtime, const char* format) {
  const std::time_t seconds = realtime.count() / time::kNsPerSecond;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof(text), format, &parts);
  return text;
}

}  // namespace

std::string utc_text(time::Nanoseconds realtime) { return utc(realtime, "%Y%m%dT%H%M%SZ"); }

std::string utc_words(time::Nanoseconds realtime) { return utc(realtime, "%Y-%m-%d %H:%M:%S UTC"); }

}  // namespace inslab::host
