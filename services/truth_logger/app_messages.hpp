#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/seen_numbers.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/sim/logger_state.hpp"

namespace inslab::truth_logger {

/// Which messages of the app's writers are in the log. The app numbers nothing for us; its writers count what they
/// write, so that a logger that was killed knows what it has, whatever it is sent again, and what it lacks.
class AppMessages {
 public:
  /// False when this message is in the log already.
  bool take(const std::string& topic, const dds::SampleOrigin& origin, time::Nanoseconds now) {
    if (accounts_ && !heard_at_) heard_at_ = now;
    return writers_[{topic, origin.writer}].numbers.insert(origin.number);
  }

  std::vector<sim::LoggedWriter> state() const {
    std::vector<sim::LoggedWriter> state;
    for (const auto& [key, writer] : writers_) {
      state.push_back({key.first, RunId{key.second}, {}});
      for (const auto& [first, last] : writer.numbers.ranges()) state.back().numbers.push_back({first, last});
    }
    return state;
  }
  /// Goes on for the process that left this state, before what its tail holds is taken.
  void go_on(const std::vector<sim::LoggedWriter>& state) {
    for (const sim::LoggedWriter& logged : state) {
      dds::SeenNumbers::Ranges ranges;
      for (const streams::NumberRange& range : logged.numbers) ranges[range.first] = range.last;
      writers_[{logged.topic, logged.writer.bytes}].numbers = dds::SeenNumbers(std::move(ranges));
    }
  }
  /// From now on what is missing counts.
  void begin_account() {
    accounts_ = true;
    for (auto& [key, writer] : writers_) writer.had = writer.numbers.last();
  }
  /// Something new has come: a writer that keeps what it wrote knows of this logger, and what lies between is missing.
  void caught_up() { caught_up_ = true; }
  /// Whether it is known what is missing. `they_keep`: some writer keeps what it wrote, and gives it bit by bit.
  bool account_is_due(bool they_keep, time::Nanoseconds now) const {
    constexpr time::Nanoseconds kToMatch = std::chrono::seconds(5);
    constexpr time::Nanoseconds kToGive = std::chrono::seconds(15);
    if (!accounts_ || !heard_at_) return false;
    if (they_keep && caught_up_ && missing_in_all() == 0) return true;
    return now - *heard_at_ > (they_keep ? kToGive : kToMatch);
  }
  bool accounts() const { return accounts_; }
  void end_account() { accounts_ = false; }
  /// By topic, how many messages of those after begin_account() have not come though later ones have. Those of a writer
  /// that has gone meanwhile, or that has written nothing since, nobody knows of.
  std::map<std::string, std::uint64_t> missing() const {
    std::map<std::string, std::uint64_t> missing;
    for (const auto& [key, writer] : writers_) {
      if (writer.numbers.last() > writer.had) missing[key.first] += writer.numbers.missing_after(writer.had);
    }
    return missing;
  }

 private:
  std::uint64_t missing_in_all() const {
    std::uint64_t sum = 0;
    for (const auto& [topic, count] : missing()) sum += count;
    return sum;
  }

  struct Writer {
    dds::SeenNumbers numbers;
    std::uint64_t had = 0;  ///< the newest when the account began
  };

  std::map<std::pair<std::string, std::array<std::uint8_t, 16>>, Writer> writers_;
  bool accounts_ = false;
  bool caught_up_ = false;
  std::optional<time::Nanoseconds> heard_at_;  ///< the first message since begin_account()
};

}  // namespace inslab::truth_logger
