// Joins a TAP device of one network namespace to one of another, as a cable does that is long and not good: frames
// arrive late, some not at all, and while the link is down (SIGUSR1; SIGUSR2 brings it up again) none.

#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <deque>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t link_is_down = 0;
volatile std::sig_atomic_t told_to_end = 0;

/// A TAP device in a namespace; the descriptor works from everywhere.
int open_tap(const std::string& network_namespace, const std::string& device) {
  const std::string place = "/run/netns/" + network_namespace;
  const int where = open(place.c_str(), O_RDONLY | O_CLOEXEC);
  if (where < 0 || setns(where, CLONE_NEWNET) != 0) throw std::runtime_error(place + ": " + std::strerror(errno));
  close(where);
  const int tap = open("/dev/net/tun", O_RDWR | O_CLOEXEC | O_NONBLOCK);
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  device.copy(request.ifr_name, IFNAMSIZ - 1);
  if (tap < 0 || ioctl(tap, TUNSETIFF, &request) != 0) throw std::runtime_error(device + ": " + std::strerror(errno));
  return tap;
}

struct Frame {
  Clock::time_point due;
  int to;
  std::vector<char> bytes;
};

struct Cable {
  std::chrono::milliseconds delay;
  double loss;
  std::mt19937 random{1};
  std::deque<Frame> under_way{};

  void take(int from, int to) {
    char bytes[65536];
    for (ssize_t size = read(from, bytes, sizeof(bytes)); size > 0; size = read(from, bytes, sizeof(bytes))) {
      const bool lost = std::uniform_real_distribution<>(0.0, 1.0)(random) < loss;
      if (!lost && link_is_down == 0) under_way.push_back({Clock::now() + delay, to, {bytes, bytes + size}});
    }
  }
  void deliver() {
    for (; !under_way.empty() && under_way.front().due <= Clock::now(); under_way.pop_front()) {
      const Frame& frame = under_way.front();
      // A full queue loses the frame, as a cable's does.
      if (write(frame.to, frame.bytes.data(), frame.bytes.size()) < 0 && errno != EAGAIN) std::perror("tap_relay");
    }
  }
  int wait_ms() const {
    if (under_way.empty()) return 100;
    const auto left = under_way.front().due - Clock::now();
    return std::max(0, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(left).count()));
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> ends;
  int delay_ms = 0;
  double loss = 0.0;
  CLI::App app("A long, bad cable between two network namespaces", "tap_relay");
  app.add_option("ends", ends, "NAMESPACE DEVICE NAMESPACE DEVICE")->required()->expected(4);
  app.add_option("--delay-ms", delay_ms, "of every frame")->check(CLI::Range(0, 10'000));
  app.add_option("--loss", loss, "share of the frames")->check(CLI::Range(0.0, 1.0));
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGUSR1, [](int) { link_is_down = 1; });
  std::signal(SIGUSR2, [](int) { link_is_down = 0; });
  std::signal(SIGTERM, [](int) { told_to_end = 1; });
  try {
    const int a = open_tap(ends[0], ends[1]);
    const int b = open_tap(ends[2], ends[3]);
    std::printf("ready\n");
    std::fflush(stdout);
    Cable cable{std::chrono::milliseconds(delay_ms), loss};
    while (told_to_end == 0) {
      pollfd ready[] = {{a, POLLIN, 0}, {b, POLLIN, 0}};
      poll(ready, 2, cable.wait_ms());
      cable.take(a, b);
      cable.take(b, a);
      cable.deliver();
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tap_relay: %s\n", error.what());
    return 1;
  }
  return 0;
}
