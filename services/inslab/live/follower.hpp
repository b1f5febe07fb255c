#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/client/run_link.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::live {

/// Goes along with a run that others started, from before its first sample to its end: sends its swaps, lets it begin.
/// Times are those of CLOCK_MONOTONIC.
class Follower {
 public:
  struct Options {
    double timeout_s = 60.0;  ///< of silence
    bool release = false;     ///< let a run that was started paused begin when all swaps are in its journal
    std::string where;        ///< in which a trajectory server is waited for, for messages
    std::vector<catalog::AnyProfile> swaps;  ///< to be sent
  };
  /// Who hears what goes on.
  struct Audience {
    std::function<void(const std::string&)> event;  ///< "run 0a1b...", "begins", "ends"
    std::function<void(const std::string&)> word;   ///< what is waited for
    std::function<void(time::Nanoseconds sim_time)> progress;
  };
  struct Ending {
    bool good = false;
    std::string why;  ///< when it is not
  };

  /// `link` is used until the end.
  Follower(client::RunLink& link, Options options, Audience audience, time::Nanoseconds now);

  /// Does what is due; the ending when there is nothing more to wait for. Call every few milliseconds.
  std::optional<Ending> step(time::Nanoseconds now);

 private:
  Ending end(const SimStatus& status) const;
  std::optional<std::string> silence(const std::optional<SimStatus>& status, time::Nanoseconds now);
  void say_whose_it_is(const SimStatus& status);
  void say_when_it_begins(const SimStatus& status);
  void send_swaps();
  void release(const SimStatus& status, time::Nanoseconds now);

  client::RunLink& link_;
  Options options_;
  Audience audience_;
  std::size_t next_swap_ = 0;
  bool said_run_ = false;
  bool begun_ = false;
  bool released_ = false;
  bool told_ = false;           ///< what it waits for
  std::uint64_t statuses_ = 0;  ///< heard so far
  time::Nanoseconds begun_at_;
  time::Nanoseconds heard_at_;            ///< when a status came last
  time::Nanoseconds resume_again_at_{0};  ///< a command may be lost with its server's barrier still open
};

}  // namespace inslab::live
