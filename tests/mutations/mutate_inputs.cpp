// Spoils good inputs and reads them: no crash, nothing that takes more than 5 s, and no refusal without the file, the
// reason and words that a user understands. What breaks one of these is kept.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/output_place.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "tests/mutations/mutator.hpp"
#include "tests/mutations/targets.hpp"

namespace {

using namespace inslab;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kLongest{5}, kLongestWait{60};

struct Options {
  std::string kind;
  std::uint64_t count = 2000;
  std::uint64_t seed = 1;
  double minutes = 0.0;
};

/// The process's time on a processor: what an input takes, however busy the machine is.
std::chrono::nanoseconds processor_time() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// Ends the process when one input takes too long, on a processor or by waiting; the input is the file that is there
/// then.
class Watchdog {
 public:
  Watchdog() : thread_([this] { watch(); }) {}
  ~Watchdog() {
    done_ = true;
    thread_.join();
  }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  void begin(const std::string& what) {
    what_ = what;
    processor_began_ = processor_time().count();
    began_ = Clock::now().time_since_epoch().count();
  }
  void end() { began_ = 0; }

 private:
  void watch() {
    while (!done_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      const Clock::rep began = began_;
      if (began == 0) continue;
      const bool works = processor_time() - std::chrono::nanoseconds(processor_began_) > kLongest;
      const bool waits = Clock::now().time_since_epoch() - Clock::duration(began) > kLongestWait;
      if (!works && !waits) continue;
      std::cerr << what_ << ": takes more than 5 s\n";
      _exit(1);
    }
  }

  std::string what_;
  std::atomic<Clock::rep> began_{0};
  std::atomic<std::chrono::nanoseconds::rep> processor_began_{0};
  std::atomic<bool> done_{false};
  std::thread thread_;
};

/// What is wrong with a refusal; empty: nothing.
std::string fault_of(const std::string& message, const std::string& path) {
  constexpr std::size_t kLongestMessage = 4000;
  if (message.find(path) == std::string::npos) return "does not name the file";
  if (message.size() < message.find(path) + path.size() + 8) return "gives no reason";
  if (message.size() > kLongestMessage) return "has " + std::to_string(message.size()) + " characters";
  for (const char* raw : {"exception.", "std::", "bad_alloc", "stoi", "stod", "basic_string",
                          "vector::", "map::", "optional", "YAML::", "::_M_", "what()"}) {
    if (message.find(raw) != std::string::npos) return "is the raw words of a library";
  }
  return "";
}

std::vector<mutations::Seed> seeds_of(const std::string& kind, const std::string& folder) {
  if (kind == "scenarios") return mutations::scenario_seeds();
  if (kind == "profiles") return mutations::profile_seeds();
  if (kind == "texts") return mutations::text_seeds(folder);
  if (kind == "imports") return mutations::import_seeds();
  return mutations::log_seeds(folder);
}

class Hunt {
 public:
  Hunt(const Options& options, std::string kind, const std::filesystem::path& folder)
      : options_(options), kind_(std::move(kind)), folder_(folder.string()), seeds_(seeds_of(kind_, folder_)) {}

  /// One mutation; the same for the same number.
  void one(std::uint64_t number, Watchdog& watchdog) {
    const mutations::Seed& seed = seeds_[number % seeds_.size()];
    mutations::Mutator mutator(options_.seed * 1'000'003 + number);
    const std::string path = folder_ + "/" + seed.name;
    const std::string bytes = mutator.mutated(seed.bytes, kind_ != "logs");
    std::ofstream(path, std::ios::binary) << bytes;
    const std::string place = fmt::format("{} of {}, number {}, kept as {}", kind_, seed.name, number, path);
    watchdog.begin(place);
    std::string fault, message;
    try {
      mutations::read(path, seed, folder_);
      ++accepted_;
    } catch (const json::Error& error) {
      message = error.what();
      fault = fault_of(message, folder_);
    } catch (const files::ReadError& error) {
      message = error.what();
      fault = fault_of(message, folder_);
    } catch (const std::domain_error& error) {  // a motion that leaves its domain while it runs
      message = error.what();
      fault = fault_of(message, folder_);
    } catch (const std::exception& error) {
      message = error.what();
      fault = "is of a kind that no command expects of an input";
    }
    watchdog.end();
    if (fault.empty()) return;
    ++faults_;
    const std::string kept = fmt::format("{}.{}", path, number);
    std::ofstream(kept, std::ios::binary) << bytes;
    std::cerr << fmt::format("{} of {}, number {}, kept as {}: the refusal {}: {}\n", kind_, seed.name, number, kept,
                             fault, text::cut(text::shown(message), 600));
  }

  std::uint64_t faults() const { return faults_; }
  void report(std::uint64_t count) const {
    std::cout << fmt::format("{}: {} mutations, {} accepted, {} refused, {} faults\n", kind_, count, accepted_,
                             count - accepted_, faults_);
  }

 private:
  const Options& options_;
  std::string kind_;
  std::string folder_;
  std::vector<mutations::Seed> seeds_;
  std::uint64_t accepted_ = 0;
  std::uint64_t faults_ = 0;
};

/// The mutated scenario lies where its profiles are found.
std::filesystem::path folder_for(const std::string& kind) {
  const std::filesystem::path root =
      std::filesystem::temp_directory_path() / fmt::format("inslab_mutations_{}_{}", kind, ::getpid());
  const std::filesystem::path folder = root / "scenarios";
  std::filesystem::create_directories(folder);
  const std::filesystem::path config = std::filesystem::path(INSLAB_SOURCE_DIR) / "config";
  std::filesystem::create_directory_symlink(config / "profiles", root / "profiles");
  std::filesystem::create_directory_symlink(config / "nav", root / "nav");
  for (const char* file : {"matrix.csv"}) {
    std::filesystem::copy_file(config / "scenarios" / file, folder / file);
  }
  return folder;
}

int hunt(const Options& options) {
  std::vector<std::string> kinds{"scenarios", "profiles", "texts", "imports", "logs"};
  if (!options.kind.empty()) kinds = {options.kind};
  Watchdog watchdog;
  std::uint64_t faults = 0;
  for (const std::string& kind : kinds) {
    const std::filesystem::path folder = folder_for(kind);
    Hunt one_kind(options, kind, folder);
    const auto share = std::chrono::duration<double>(60.0 * options.minutes / static_cast<double>(kinds.size()));
    const auto began = Clock::now();
    std::uint64_t number = 0;
    const auto goes_on = [&] { return options.minutes > 0.0 ? Clock::now() - began < share : number < options.count; };
    for (; goes_on(); ++number) one_kind.one(number, watchdog);
    one_kind.report(number);
    faults += one_kind.faults();
    if (one_kind.faults() == 0) std::filesystem::remove_all(folder.parent_path());
  }
  return faults == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Spoils inputs of every kind and reads them", "mutate_inputs");
  app.add_option("kind", options.kind, "scenarios, profiles, texts, imports or logs; absent: all of them");
  app.add_option("--count", options.count, "mutations of each kind")->capture_default_str();
  app.add_option("--seed", options.seed, "of the mutations")->capture_default_str();
  app.add_option("--minutes", options.minutes, "for so long in all, instead of a count");
  CLI11_PARSE(app, argc, argv);
  files::set_output_rule(files::OutputRule::ReplaceResults);
  return hunt(options);
}
