#include "inslab/referee/verify/known_misses.hpp"

#include <algorithm>
#include <string_view>

namespace inslab::verify {

namespace {

enum Figure : std::size_t { kHorizontal, kVertical, kRoll, kPitch, kYaw };

struct KnownMiss {
  Against against;
  std::string_view imu;
  Figure figure;
  Side side;
  double by;  ///< the larger factor of both motions, preset seed, as docs/verification.md has it
};

constexpr KnownMiss kKnown[] = {
    {Against::Simulated, "pos830", kHorizontal, Side::Below, 1.28},
    {Against::Simulated, "pos830", kRoll, Side::Below, 1.32},
    {Against::Simulated, "pos830", kPitch, Side::Below, 1.27},
    {Against::Simulated, "pos830", kYaw, Side::Below, 1.91},
    {Against::Measured, "pos830", kHorizontal, Side::Below, 3.32},
    {Against::Measured, "pos830", kVertical, Side::Above, 1.27},
    {Against::Measured, "pos830", kRoll, Side::Below, 2.12},
    {Against::Measured, "pos830", kPitch, Side::Below, 2.46},
    {Against::Measured, "pos830", kYaw, Side::Below, 3.55},
    {Against::Measured, "stim300", kRoll, Side::Below, 1.72},
    {Against::Measured, "stim300", kPitch, Side::Below, 2.31},
    {Against::Measured, "stim300", kYaw, Side::Below, 1.93},
    {Against::Measured, "adis16488", kHorizontal, Side::Above, 1.30},
};

}  // namespace

bool is_known_miss(Against against, const char* imu, std::size_t figure, Side side, double by) {
  constexpr double kOfOtherSeeds = 1.5;
  return std::any_of(std::begin(kKnown), std::end(kKnown), [&](const KnownMiss& known) {
    return known.against == against && known.imu == imu && known.figure == figure && known.side == side &&
           by <= kOfOtherSeeds * known.by;
  });
}

}  // namespace inslab::verify
