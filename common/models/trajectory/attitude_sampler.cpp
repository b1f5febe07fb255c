#include "inslab/models/trajectory/attitude_sampler.hpp"

#include <sstream>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::trajectory {

namespace {

constexpr time::Nanoseconds kNearest{10000000};
constexpr time::Nanoseconds kFirstOfWait{100000000};
// What a nose that follows its path may turn within kNearest: 1100 deg/s.
constexpr double kJump_rad = 0.2;
// Each attitude further on moves a cubic spline by 0.27 of what the one before it does: 0.27^40 is 1e-23.
constexpr std::size_t kReach = 40;

/// Chooses the instants whose attitudes the rotation spline goes through.
class AttitudeSampler {
 public:
  AttitudeSampler(const Path& path, AttitudeLaw& law, const JumpWords& words, std::optional<time::Nanoseconds> end)
      : path_(path), law_(law), words_(words), end_(end) {}

  /// What is kept reaches so far beyond the end that nothing after it is felt before it.
  bool is_enough() const { return beyond_end_ >= kReach; }

  void add(std::size_t index) {
    index_ = index;
    const PathPiece piece = path_.piece(index);
    if (knots_.empty()) keep(piece.start, law_.q_ev(piece, piece.start));
    if (law_.rests(piece)) {
      add_wait(piece);
    } else {
      halve(piece, piece.start, knots_.back().q_ev, piece.end, law_.q_ev(piece, piece.end));
    }
  }

  std::unique_ptr<const AttitudeCurve> take() {
    while (law_.is_graded() && halve_beside_shorter()) continue;
    std::vector<time::Nanoseconds> times;
    std::vector<nav::Quaternion> q_ev;
    for (const Knot& knot : knots_) {
      times.push_back(knot.instant);
      q_ev.push_back(knot.q_ev);
    }
    return std::make_unique<AttitudeCurve>(std::move(times), std::move(q_ev));
  }

 private:
  struct Knot {
    time::Nanoseconds instant;
    nav::Quaternion q_ev;
    std::size_t piece;  ///< that leads to it
  };

  void keep(time::Nanoseconds instant, const nav::Quaternion& q_ev) {
    knots_.push_back({instant, q_ev, index_});
    if (end_ && instant > *end_) ++beyond_end_;
  }

  /// Halves each interval that is more than twice as long as one beside it; false when there is none.
  bool halve_beside_shorter() {
    const auto length = [this](std::size_t k) { return knots_[k].instant - knots_[k - 1].instant; };
    std::vector<Knot> finer{knots_.front()};
    for (std::size_t k = 1; k < knots_.size(); ++k) {
      const bool before = k > 1 && length(k) > 2 * length(k - 1);
      const bool after = k + 1 < knots_.size() && length(k) > 2 * length(k + 1);
      if (before || after) {
        const time::Nanoseconds middle = knots_[k - 1].instant + length(k) / 2;
        finer.push_back({middle, law_.q_ev(path_.piece(knots_[k].piece), middle), knots_[k].piece});
      }
      finer.push_back(knots_[k]);
    }
    const bool is_finer = finer.size() > knots_.size();
    knots_ = std::move(finer);
    return is_finer;
  }

  /// Keeps what is needed between two instants, and the second.
  void halve(const PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
             const nav::Quaternion& q1) {
    if (is_enough()) return;
    const bool far = law_.far(piece, t0, q0, t1, q1);
    if (far && t1 - t0 > kNearest) {
      const time::Nanoseconds middle = (t0 + t1) / 2;
      const nav::Quaternion q_middle = law_.q_ev(piece, middle);
      halve(piece, t0, q0, middle, q_middle);
      halve(piece, middle, q_middle, t1, q1);
      return;
    }
    if (t1 - t0 <= kNearest && nav::angle_between(q0, q1) > kJump_rad) {
      std::ostringstream why;
      why << "the nose turns by " << nav::angle_between(q0, q1) / units::kDeg << " deg within "
          << time::to_seconds(t1 - t0) << " s at " << time::to_seconds(t0) << " s, on the way from " << words_.place
          << ' ' << piece.index << ": a vehicle that follows its nose cannot; expected " << words_.remedy;
      throw std::domain_error(why.str());
    }
    keep(t1, q1);
  }

  /// Intervals that grow from both ends: what is left of the motion's rate dies away within the first few.
  void add_wait(const PathPiece& piece) {
    const nav::Quaternion q_ev = knots_.back().q_ev;
    std::vector<time::Nanoseconds> from_end;
    const time::Nanoseconds half = (piece.end - piece.start) / 2;
    for (time::Nanoseconds t = kFirstOfWait; t < half; t *= 2) {
      keep(piece.start + t, q_ev);
      from_end.push_back(piece.end - t);
    }
    for (std::size_t i = from_end.size(); i-- > 0;) keep(from_end[i], q_ev);
    keep(piece.end, q_ev);
  }

  const Path& path_;
  AttitudeLaw& law_;
  JumpWords words_;
  std::optional<time::Nanoseconds> end_;
  std::size_t beyond_end_ = 0;
  std::size_t index_ = 0;  ///< of the piece that is added
  std::vector<Knot> knots_;
};

}  // namespace

std::unique_ptr<const AttitudeCurve> sampled_attitude(const Path& path, AttitudeLaw& law, const JumpWords& words,
                                                      std::optional<time::Nanoseconds> end) {
  AttitudeSampler attitudes(path, law, words, end);
  for (std::size_t i = 0; i < path.pieces() && !attitudes.is_enough(); ++i) attitudes.add(i);
  return attitudes.take();
}

}  // namespace inslab::trajectory
