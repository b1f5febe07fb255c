#include "inslab/referee/calibrate/phase_store.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::calibrate {
namespace phase_store_test {

TEST(PhaseStore, GivesBackWhatIsHeldAndWhatWentToTheFile) {
  // More than two times what is held; multiples of 1/4 add up exactly.
  constexpr int kSamples = 9'000'000;
  PhaseStore store;
  store.add(0.25);
  for (int k = 1; k < kSamples; ++k) store.add(0.25 * (k % 3));
  ASSERT_EQ(store.samples(), kSamples);
  for (int look = 0; look < 2; ++look) {
    const std::vector<double> phase = store.phase();
    ASSERT_EQ(phase.size(), std::size_t{kSamples} + 1);
    EXPECT_EQ(phase[1], 0.0);
    for (int k = 1; k < kSamples; ++k) {
      ASSERT_EQ(phase[static_cast<std::size_t>(k) + 1] - phase[static_cast<std::size_t>(k)], 0.25 * (k % 3) - 0.25);
    }
  }
  store.add(0.5);
  EXPECT_EQ(store.phase().size(), std::size_t{kSamples} + 2);
}

TEST(PhaseStore, NamesTheFolderThatHasNoPlaceForItsFile) {
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", "/proc", 1);
  PhaseStore store;
  std::string said;
  try {
    for (int k = 0; k < 5'000'000; ++k) store.add(0.25);
  } catch (const files::WriteError& error) {
    said = error.what();
  }
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
  EXPECT_EQ(said.rfind("/proc: ", 0), 0u) << said;
  EXPECT_NE(said.find("TMPDIR"), std::string::npos) << said;
}

}  // namespace phase_store_test
}  // namespace inslab::calibrate
