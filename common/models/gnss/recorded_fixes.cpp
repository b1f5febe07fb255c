#include "inslab/models/gnss/recorded_fixes.hpp"

#include <algorithm>
#include <stdexcept>

#include "inslab/data/profiles/fix_recording_place.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::gnss {
namespace {

/// A real receiver's epochs lie within this of their instants.
constexpr time::Nanoseconds kSame{1'000'000};

RecordedFixErrors::Epoch between(const RecordedFixErrors::Epoch& a, const RecordedFixErrors::Epoch& b, double share) {
  const auto mixed = [share](const Vector3& from, const Vector3& to) -> Vector3 { return from + share * (to - from); };
  RecordedFixErrors::Epoch epoch;
  epoch.position_ned_m = mixed(a.position_ned_m, b.position_ned_m);
  epoch.velocity_ned_m_per_s = mixed(a.velocity_ned_m_per_s, b.velocity_ned_m_per_s);
  epoch.position_sigma_ned_m = a.position_sigma_ned_m.cwiseMax(b.position_sigma_ned_m);
  epoch.velocity_sigma_ned_m_per_s = a.velocity_sigma_ned_m_per_s.cwiseMax(b.velocity_sigma_ned_m_per_s);
  epoch.fix_type = std::min(a.fix_type, b.fix_type);
  return epoch;
}

}  // namespace

RecordedFixes::RecordedFixes(const RecordedFixError& profile, const Run& run) {
  if (profile.file.empty()) return;
  if (!run.find) throw std::invalid_argument(profile.file + ": there are no recordings here");
  try {
    recording_ = run.find(profile.file, profile.sha256);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
  from_ = profiles::begin_of(*recording_, profile, run.end,
                             random::Stream(run.seed, run.sensor + "/recorded_error").uniform(0));
}

std::optional<RecordedFixErrors::Epoch> RecordedFixes::at(time::Nanoseconds t) const {
  const auto& epochs = recording_->epochs;
  const time::Nanoseconds there = from_ + t;
  const auto after = std::lower_bound(epochs.begin(), epochs.end(), there,
                                      [](const auto& epoch, time::Nanoseconds at) { return epoch.time < at; });
  if (after != epochs.end() && after->time - there <= kSame) return *after;
  if (after == epochs.begin()) return std::nullopt;
  const auto before = after - 1;
  if (there - before->time <= kSame) return *before;
  if (after == epochs.end() || 2 * (after->time - before->time) > 3 * recording_->interval) return std::nullopt;
  return between(*before, *after,
                 time::to_seconds(there - before->time) / time::to_seconds(after->time - before->time));
}

}  // namespace inslab::gnss
