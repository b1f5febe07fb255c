#include "inslab/bus/service/scenario_hash.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace inslab::service {
namespace scenario_hash_test {

namespace fs = std::filesystem;

class ScenarioHash : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    write("imu.json", R"({"name": "one", "gyro": {"bias_constant_deg_per_h": [1, 0, 0]}})");
    fs::copy_file(fs::path(INSLAB_SOURCE_DIR) / "config/profiles/gnss/rtk.json", folder_ / "gnss.json");
    write("scenario.json", scenario("7"));
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string scenario(const std::string& seed) {
    return R"({"name": "s", "seed": )" + seed + R"(, "start": {"at": "now"}, "duration_s": 1, "truth_rate_hz": 200,
      "trajectory": {"initial": {"latitude_deg": 0, "longitude_deg": 0, "height_m": 0},
                     "segments": [{"duration_s": 1, "motions": []}]},
      "imu": [{"number": 0, "rate_hz": 200, "error_profile": "imu.json"}],
      "gnss": [{"number": 0, "rate_hz": 10, "error_profile": "gnss.json"}]})";
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string hash() const { return scenario_hash(scenario::load(folder_ / "scenario.json")); }

  fs::path folder_ = fs::temp_directory_path() / ("inslab-hash-" + std::to_string(getpid()));
};

TEST_F(ScenarioHash, IsThatOfWhatTheFilesSayAndNotOfTheirLayout) {
  const std::string before = hash();
  EXPECT_EQ(before.size(), 64u);
  write("imu.json", "{\n \"gyro\": {\"bias_constant_deg_per_h\": [1.0, 0, 0]},\n \"name\": \"one\"\n}\n");
  EXPECT_EQ(hash(), before);
}

TEST_F(ScenarioHash, ChangesWithTheSeedAndWithAProfileThatIsNamed) {
  const std::string before = hash();
  write("scenario.json", scenario("8"));
  const std::string of_another_seed = hash();
  EXPECT_NE(of_another_seed, before);
  write("scenario.json", scenario("7"));
  EXPECT_EQ(hash(), before);
  write("imu.json", R"({"name": "one", "gyro": {"bias_constant_deg_per_h": [1, 0, 1e-9]}})");
  EXPECT_NE(hash(), before);
}

TEST_F(ScenarioHash, IsTheSameWhereTheTrajectorysRowsAreNotRead) {
  const fs::path file = fs::path(INSLAB_SOURCE_DIR) / "tests/data/from_file.json";
  EXPECT_EQ(scenario_hash(scenario::load(file)),
            scenario_hash(scenario::load(file, "", scenario::TrajectoryRows::LeaveOut)));
}

}  // namespace scenario_hash_test
}  // namespace inslab::service
