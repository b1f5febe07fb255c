#pragma once

#include <string>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::live {

/// A bar on a terminal; on anything else a line every tenth of the way.
class Progress {
 public:
  Progress(const std::string& name, time::Nanoseconds duration);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(time::Nanoseconds sim_time);
  /// A line of its own, above the bar.
  void say(const std::string& line) const;

 private:
  std::string name_;
  double duration_s_;
  bool terminal_;
  int shown_ = -1;
};

}  // namespace inslab::live
