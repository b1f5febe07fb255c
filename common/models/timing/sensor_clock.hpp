#pragma once

#include <cstdint>
#include <string>

#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"
#include "inslab/data/samples/stream_header.hpp"
#include "inslab/noise/random/gauss_markov.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::timing {

/// The clock of one sensor of any kind, which tags its samples: what stands in a sample's GPS week and time of week.
/// Sample k, valid at t, gets the tag of the time
///
///   t + offset + drift (t - t0) + the steps up to t + white jitter + Gauss-Markov jitter
///
/// cut to whole counts of the quantization in the GPS week, the nearest one; t0 is where the drift came into use, sim
/// time 0 or a swap that brought another. Sim time in the header stays that of validity: it is the order of samples in
/// lockstep, logs and journals, and the tag's error is the difference of both. The draws depend on (seed, sensor, k)
/// alone.
class SensorClock {
 public:
  /// `sensor` is the root of the stream names, such as "gnss0". Throws std::invalid_argument as random::GaussMarkov
  /// does.
  SensorClock(const TimeTagErrors& errors, double period_s, std::uint64_t seed, const std::string& sensor);

  bool is_off() const { return is_off_; }

  /// Takes other errors; what goes on from sample to sample stays.
  void use(const TimeTagErrors& errors);
  /// Takes other errors between two samples, the last of them `k`, at sim time `time_ns`. Keep: the Gauss-Markov jitter
  /// keeps its size in units of sigma, the drift goes on if it is the same. Reset and Redraw: both begin afresh.
  void retune(const TimeTagErrors& errors, Continuity continuity, std::uint64_t k, std::int64_t time_ns);

  /// The header of sample `k`, k >= 1, as the sensor tags it. Samples come in order, each once, those too that are not
  /// put out: the Gauss-Markov state advances.
  StreamHeader tagged(const StreamHeader& header, std::uint64_t k);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.jitter_, self.drifts_since_ns_);
  }

 private:
  TimeTagErrors errors_;
  bool is_off_ = true;
  random::NormalCursor white_;
  random::GaussMarkov jitter_;
  std::int64_t drifts_since_ns_ = 0;
};

}  // namespace inslab::timing
