#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "inslab/services/inslab/study/process_usage.hpp"

namespace inslab::study {

/// What the services of a set held in the first and in the last third of a run, and whether that grew.
class UsageWatch {
 public:
  /// Whether what is held at this part of the run, from 0 to 1, is wanted.
  static bool wants(double part) { return part <= 0.34 || part >= 0.66; }
  void add(const std::string& program, double part, const ProcessUsage& usage);

  /// The table of the most that each held.
  std::string text() const;
  /// What grew, in words.
  std::vector<std::string> growth() const;

 private:
  struct Peaks {
    ProcessUsage first;
    ProcessUsage last;
  };
  std::map<std::string, Peaks> peaks_;
};

}  // namespace inslab::study
