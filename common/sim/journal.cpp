#include "inslab/sim/journal.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::sim {

ProfileAck rejected(const catalog::AnyProfile& request, const std::string& field, const std::string& reason) {
  ProfileAck ack;
  ack.request_id = catalog::request_of(request).request_id;
  ack.kind = catalog::kind_of(request);
  ack.target = catalog::target_of(request);
  ack.outcome = AckOutcome::Rejected;
  ack.requested_time_ns = catalog::request_of(request).apply_at_ns;
  // Bounds of the wire: a path or reason that does not fit would make the ack itself unsendable.
  ack.field = text::cut(text::shown(field), 128);
  ack.reason = text::cut(text::shown(reason), 256);
  return ack;
}

namespace {

time::Nanoseconds earliest(const catalog::AnyProfile& request, time::Nanoseconds now) {
  return time::Nanoseconds(std::max(catalog::request_of(request).apply_at_ns, now.count()));
}

}  // namespace

Journal::Journal(std::vector<SensorAddress> sensors, time::Grid truth_grid, time::Nanoseconds end)
    : sensors_(std::move(sensors)), truth_grid_(std::move(truth_grid)), end_(end) {}

std::optional<Violation> Journal::rejection_of(const catalog::AnyProfile& request, time::Nanoseconds now) const {
  if (auto broken = catalog::broken_rule(request)) return broken;
  if (std::find(sensors_.begin(), sensors_.end(), catalog::target_of(request)) == sensors_.end()) {
    return Violation{Rule::SensorExists, "target_number",
                     "names " + catalog::sensor_name(catalog::target_of(request)) + ", which this unit does not have"};
  }
  if (earliest(request, now) >= end_ || truth_grid_.at_or_after(earliest(request, now)) >= end_) {
    char text[128];
    std::snprintf(text, sizeof text, "lies at or after the end of the run at %.3f s: no sample would come out under it",
                  time::to_seconds(end_));
    return Violation{Rule::ApplyTime, "request.apply_at_ns", text};
  }
  return std::nullopt;
}

std::variant<catalog::AnyProfile, ProfileAck> Journal::submit(catalog::AnyProfile request, time::Nanoseconds now) {
  if (const auto broken = rejection_of(request, now)) return rejected(request, broken->path, broken->reason);
  ProfileRequest& head = catalog::request_of(request);
  head.requested_at_ns = head.apply_at_ns;
  head.requested_in_the_past = head.apply_at_ns >= 0 && head.apply_at_ns < now.count();
  head.apply_at_ns = truth_grid_.at_or_after(earliest(request, now)).count();
  head.journal_number = size() + 1;
  apply_times_.insert(std::upper_bound(apply_times_.begin(), apply_times_.end(), head.apply_at_ns), head.apply_at_ns);
  return request;
}

std::uint32_t Journal::in_effect(time::Nanoseconds t) const {
  return static_cast<std::uint32_t>(std::lower_bound(apply_times_.begin(), apply_times_.end(), t.count()) -
                                    apply_times_.begin());
}

bool Journal::applies_at(time::Nanoseconds t) const {
  return std::binary_search(apply_times_.begin(), apply_times_.end(), t.count());
}

}  // namespace inslab::sim
