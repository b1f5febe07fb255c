#include "inslab/models/gnss/solution_ladder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace inslab::gnss {
namespace solution_ladder_test {

LesserSolution rung(FixType type, double lasts_s, double mean_time_between_falls_s = 0.0) {
  LesserSolution solution;
  solution.fix_type = type;
  solution.lasts_s = lasts_s;
  solution.mean_time_between_falls_s = mean_time_between_falls_s;
  return solution;
}

/// None for 1.5 s, single for 2 s, float for 10 s, then fixed.
GnssErrorProfile rtk() {
  GnssErrorProfile profile;
  profile.fix_type = FixType::Fixed;
  profile.lesser_solutions = {rung(FixType::None, 1.5), rung(FixType::Single, 2.0), rung(FixType::Float, 10.0)};
  return profile;
}

/// Runs a ladder in steps of its period.
class Climb {
 public:
  explicit Climb(const GnssErrorProfile& profile, double period_s = 0.5)
      : period_ns_(static_cast<std::int64_t>(period_s * 1e9)), ladder_(profile, period_s, 7, "gnss0") {}

  /// The rung of the next epoch; -1 for none at all.
  int next(bool signals = true) {
    ++k_;
    const auto rung = ladder_.advance(k_, static_cast<std::int64_t>(k_) * period_ns_, signals);
    return rung ? static_cast<int>(*rung) : -1;
  }
  SolutionLadder& ladder() { return ladder_; }
  double time_s() const { return static_cast<double>(k_) * static_cast<double>(period_ns_) * 1e-9; }

 private:
  std::int64_t period_ns_;
  SolutionLadder ladder_;
  std::uint64_t k_ = 0;
};

TEST(SolutionLadder, BeginsAtTheTopAndStaysThere) {
  Climb climb(rtk());
  for (int i = 0; i < 100; ++i) EXPECT_EQ(climb.next(), 3);
}

TEST(SolutionLadder, ClimbsFromTheBottomAfterAnOutageInTheStatedTimesAtAnyRate) {
  for (const double period_s : {0.02, 0.1, 0.5}) {
    Climb climb(rtk(), period_s);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(climb.next(false), -1);
    climb.next();
    const double back_s = climb.time_s();
    while (climb.time_s() < 20.0) {
      const int rung = climb.next();
      const double since_s = climb.time_s() - back_s + 1e-9;
      EXPECT_EQ(rung, since_s < 1.5 ? 0 : since_s < 3.5 ? 1 : since_s < 13.5 ? 2 : 3) << period_s << ' ' << since_s;
    }
  }
}

TEST(SolutionLadder, BeginsAnewAfterAnOutageDuringTheClimb) {
  Climb climb(rtk());
  climb.next(false);
  for (int i = 0; i < 10; ++i) climb.next();
  EXPECT_EQ(climb.next(), 2);
  EXPECT_EQ(climb.next(false), -1);
  EXPECT_EQ(climb.next(), 0);
}

TEST(SolutionLadder, WithoutRungsIsAtTheTopAsSoonAsThereAreSignals) {
  Climb climb(GnssErrorProfile{});
  EXPECT_EQ(climb.next(false), -1);
  EXPECT_EQ(climb.next(), 0);
}

/// Top, and one rung that is left at the next epoch: whether each epoch fell.
std::vector<bool> falls(const GnssErrorProfile& profile, FixType to, int epochs) {
  Climb climb(profile);
  std::vector<bool> fell;
  for (int i = 0; i < epochs; ++i) {
    const auto rung = static_cast<std::size_t>(climb.next());
    fell.push_back(rung < profile.lesser_solutions.size() && profile.lesser_solutions[rung].fix_type == to);
  }
  return fell;
}

TEST(SolutionLadder, FallsAsOftenAsItsMeanTimeSays) {
  // Every epoch of 0.5 s falls with p = 1 - exp(-0.5/5); a count of N has standard deviation sqrt(N p (1 - p)).
  GnssErrorProfile profile;
  profile.lesser_solutions = {rung(FixType::None, 0.0, 5.0)};
  constexpr int kEpochs = 100000;
  double count = 0.0;
  for (const bool fell : falls(profile, FixType::None, kEpochs)) count += fell ? 1.0 : 0.0;
  const double p = 1.0 - std::exp(-0.1);
  EXPECT_NEAR(count, kEpochs * p, 4.0 * std::sqrt(kEpochs * p * (1.0 - p)));
}

TEST(SolutionLadder, ARungMoreChangesNoFallOfAnother) {
  GnssErrorProfile one, two;
  one.fix_type = two.fix_type = FixType::Fixed;
  one.lesser_solutions = {rung(FixType::Single, 0.0, 20.0)};
  two.lesser_solutions = {rung(FixType::Single, 0.0, 20.0), rung(FixType::Float, 0.0, 3.0)};
  EXPECT_EQ(falls(one, FixType::Single, 5000), falls(two, FixType::Single, 5000));
}

TEST(SolutionLadder, NeverFallsUpwards) {
  GnssErrorProfile profile = rtk();
  profile.lesser_solutions[2].mean_time_between_falls_s = 1e-3;  // at every epoch of the top
  Climb climb(profile);
  climb.next(false);
  EXPECT_EQ(climb.next(), 0);
  EXPECT_EQ(climb.next(), 0);
  EXPECT_EQ(climb.next(), 0);
  EXPECT_EQ(climb.next(), 1);
}

TEST(SolutionLadder, KeepsItsFixTypeAndItsTimeThereOverASwap) {
  Climb climb(rtk());
  climb.next(false);
  for (int i = 0; i < 9; ++i) climb.next();  // 0.5 s into float
  GnssErrorProfile other = rtk();
  other.lesser_solutions = {rung(FixType::Float, 4.0)};
  climb.ladder().retune(other, Continuity::Keep);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(climb.next(), 0) << i;  // to 3.5 s
  EXPECT_EQ(climb.next(), 1);
}

TEST(SolutionLadder, GoesToTheTopAtASwapThatDoesNotKeepOrKnowItsFixType) {
  GnssErrorProfile without_float = rtk();
  without_float.lesser_solutions.pop_back();
  for (const auto& [profile, continuity] :
       {std::pair{rtk(), Continuity::Reset}, {rtk(), Continuity::Redraw}, {without_float, Continuity::Keep}}) {
    Climb climb(rtk());
    climb.next(false);
    for (int i = 0; i < 9; ++i) climb.next();
    climb.ladder().retune(profile, continuity);
    EXPECT_EQ(climb.next(), static_cast<int>(profile.lesser_solutions.size()));
  }
}

TEST(SolutionLadder, ASwapInAnOutageFindsNoSignals) {
  Climb climb(rtk());
  climb.next(false);
  climb.ladder().retune(rtk(), Continuity::Reset);
  EXPECT_EQ(climb.next(false), -1);
  EXPECT_EQ(climb.next(), 0);
}

}  // namespace solution_ladder_test
}  // namespace inslab::gnss
