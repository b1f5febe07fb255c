#pragma once

#include "inslab/foundation/time/grid.hpp"
#include "inslab/models/trajectory/file_states.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/nav/strapdown.hpp"

namespace inslab::trajectory {

/// The truth that a strapdown algorithm makes of a file's rows: thesis 3.2.2, figure 3.7, corrected in docs/models.md.
///
/// At every instant of the grid the increments are found that carry the simulated state before it (not the file's) to
/// the file's attitude and velocity under the two-sample algorithm of nav::Strapdown, and the truth goes on from where
/// that algorithm arrives. So a navigation app with the same algorithm finds this truth again to rounding. Position
/// follows from the velocity; where a file's two contradict each other, the velocity asked for is the file's plus
/// `position_feedback_per_s` times the position's error one interval before, so that position errors stay bounded: the
/// contradiction in m/s over the feedback.
///
/// Nothing precedes the first interval: it has no coning and sculling terms. Rows need not lie on the grid (FileStates
/// tells what is between them), but the rate is then constant from row to row and jumps at each: for rows sparser than
/// the grid a spline is the better method. Time 0 is the first row.
class InverseMechanizationModel final : public TruthModel {
 public:
  struct Options {
    double position_feedback_per_s = 0.01;
    nav::Strapdown::Options strapdown;
  };

  /// Throws as FileStates and nav::Strapdown do.
  InverseMechanizationModel(std::shared_ptr<const TrajectoryFile> file, const nav::Gravity& gravity,
                            const Options& options, const time::Grid& grid, const time::GpsTime& start);

  /// `omega_iv_v` and `f_v` are the mean of the two intervals that meet at the instant, at the ends that of the only
  /// one there is. `segment_index` is 0, `rate_jump` false.
  TruthState current() const override;

  TruthState advance() override;

  /// The last instant of the grid that the file reaches.
  time::Nanoseconds end() const override { return end_; }

 private:
  nav::ImuIncrements find_next();

  FileStates states_;
  time::Grid grid_;
  time::GpsTime start_;
  double position_feedback_per_s_;
  nav::Geodetic file_position_;  ///< at the instant that `strapdown_` is at
  nav::Strapdown strapdown_;
  std::uint64_t sample_ = 0;
  time::Nanoseconds now_{0};
  time::Nanoseconds span_{0};  ///< of the interval that ends now
  time::Nanoseconds end_;
  nav::ImuIncrements interval_;  ///< ends at the instant; none at the start
  nav::ImuIncrements next_;      ///< begins there; none at the end
};

}  // namespace inslab::trajectory
