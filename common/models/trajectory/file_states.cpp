#include "inslab/models/trajectory/file_states.hpp"

#include <stdexcept>
#include <utility>

namespace inslab::trajectory {

namespace {

nav::NavState state_of(const TrajectoryRow& row) {
  return {row.position, *row.v_n, nav::quaternion_from_rpy(*row.rpy)};
}

nav::NavState between(const TrajectoryRow& from, const TrajectoryRow& to, time::Nanoseconds t) {
  const nav::NavState start = state_of(from), end = state_of(to);
  const double span_s = time::to_seconds(to.time - from.time), elapsed_s = time::to_seconds(t - from.time);
  const double share = elapsed_s / span_s;
  const nav::Vector3 dv_n = end.v_n - start.v_n;
  const nav::Vector3 beyond_velocity_m =
      nav::ned_from(start.position, end.position) - 0.5 * span_s * (start.v_n + end.v_n);
  const nav::Vector3 way_m = elapsed_s * (start.v_n + 0.5 * share * dv_n) + share * beyond_velocity_m;
  const nav::Vector3 turn_rad = nav::rotation_vector_from_quaternion(start.q_nb.conjugate() * end.q_nb);
  return {nav::displaced(start.position, way_m), start.v_n + share * dv_n,
          start.q_nb * nav::quaternion_from_rotation_vector(share * turn_rad)};
}

}  // namespace

FileStates::FileStates(std::shared_ptr<const TrajectoryFile> file) : file_(std::move(file)) {
  if (file_->rows.size() < 2) throw std::invalid_argument(file_->name + " has fewer than two rows");
  for (const TrajectoryRow& row : file_->rows) {
    if (!row.v_n || !row.rpy) {
      throw std::invalid_argument(file_->name + " has rows without " + (row.v_n ? "attitude" : "velocity"));
    }
  }
}

nav::NavState FileStates::at(time::Nanoseconds t) {
  const std::vector<TrajectoryRow>& rows = file_->rows;
  if (t < rows.front().time || t > end()) {
    throw std::domain_error(file_->name + " has rows from " + std::to_string(time::to_seconds(rows.front().time)) +
                            " s to " + std::to_string(time::to_seconds(end())) + " s, none for " +
                            std::to_string(time::to_seconds(t)) + " s");
  }
  while (row_ + 1 < rows.size() && rows[row_ + 1].time <= t) ++row_;
  return rows[row_].time == t ? state_of(rows[row_]) : between(rows[row_], rows[row_ + 1], t);
}

}  // namespace inslab::trajectory
