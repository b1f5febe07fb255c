#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "inslab/models/navigation/recent_motion.hpp"
#include "inslab/models/navigation/state_layout.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::navigation {

/// Where the filter believes to be when a measurement is predicted: the point of linearisation.
struct Situation {
  nav::Geodetic position;
  nav::Vector3 v_n = nav::Vector3::Zero();               ///< m/s
  nav::Matrix3 C_nb = nav::Matrix3::Identity();          ///< v_n = C_nb v_b
  nav::Vector3 omega_ib_b = nav::Vector3::Zero();        ///< rad/s, of the newest interval, corrected
  nav::Vector3 f_ib_b = nav::Vector3::Zero();            ///< m/s^2, the same
  nav::Vector3 rate_by_measured = nav::Vector3::Ones();  ///< 1/(1 + scale factor) of the gyros
  Estimates estimates;                                   ///< of the sensors' errors
  const RecentMotion* recent = nullptr;  ///< of the filter that is asked; null where nothing asks for it
};

/// What one measurement tells the filter: up to three rows that err together with the state, z = H x + noise. Made by
/// the header of its kind (measurements.hpp lists them), taken by InertialFilter::update(), which knows of no kind.
class Measurement {
 public:
  static constexpr Eigen::Index kMaxRows = 3;
  static constexpr std::size_t kMaxBlocks = kBlocks.size();
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;
  using Partial = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kLargestBlock>;

  /// Whether it is a receiver's word on the whole position or velocity of the IMU. A position's refusals in a row have
  /// the filter doubted and recovered from it and from the velocity beside it; the newest that was accepted ends
  /// coasting; zero velocities are weighed against both. Anything else is an aid.
  enum class Says : std::uint8_t { Aid, Position, Velocity };

  std::string_view name;
  Rows innovation;  ///< predicted less measured
  Rows R;           ///< variances of the rows' noise, each for itself
  /// The squared innovation over its covariance, chi-square with a degree of freedom a row, that it is refused beyond.
  double gate = std::numeric_limits<double>::infinity();
  Says says = Says::Aid;

  /// The rows' derivative by a block of errors; each block once. Of a block that the state lacks nothing is asked.
  void by(StateBlock block, const Partial& H) {
    assert(H.cols() == size_of(block) && count_ < kMaxBlocks);
    blocks_[count_++] = {block, H};
  }

  Eigen::Index rows() const { return innovation.size(); }

  /// Row `i` of H for a layout.
  StateVector row(Eigen::Index i, const StateLayout& layout) const {
    StateVector h = StateVector::Zero(layout.size());
    for (std::size_t k = 0; k < count_; ++k) {
      const auto& [block, H] = blocks_[k];
      if (layout.has(block)) h.segment(layout.first(block), size_of(block)) = H.row(i).transpose();
    }
    return h;
  }

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kMaxStates>;
  /// All of H.
  Matrix H(const StateLayout& layout) const {
    Matrix all = Matrix::Zero(rows(), layout.size());
    for (std::size_t k = 0; k < count_; ++k) {
      const auto& [block, H] = blocks_[k];
      if (layout.has(block)) all.middleCols(layout.first(block), size_of(block)) = H;
    }
    return all;
  }

 private:
  struct ByBlock {
    StateBlock block = StateBlock::Position;
    Partial H;
  };
  std::array<ByBlock, kMaxBlocks> blocks_;
  std::size_t count_ = 0;
};

/// What became of one measurement.
struct MeasurementResult {
  std::string_view name;
  Eigen::Index rows = 0;
  double nis = 0.0;  ///< squared innovation over its covariance: chi-square of `rows` when the filter is honest
  bool accepted = false;
};

/// What became of all measurements of one observation, in their order.
struct UpdateResult {
  std::int64_t time_ns = 0;
  std::vector<MeasurementResult> measurements;
  bool recovered = false;  ///< the filter's own position and velocity were given up for the receiver's

  /// Null when the observation had none of that name.
  const MeasurementResult* of(std::string_view name) const {
    for (const MeasurementResult& result : measurements) {
      if (result.name == name) return &result;
    }
    return nullptr;
  }
};

}  // namespace inslab::navigation
