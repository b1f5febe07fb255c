#include "inslab/scenario/motion_matrix.hpp"

#include <gtest/gtest.h>

#include "inslab/data/json/config_error.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::scenario {
namespace motion_matrix_test {

class MotionMatrix : public test::TemporaryFolder {
 protected:
  std::vector<Segment> read(const std::string& text) const {
    put(path("matrix.csv"), text);
    return read_motion_matrix(path("matrix.csv"));
  }

  /// The only motion of the only line.
  Motion motion(const std::string& line) const {
    const std::vector<Segment> segments = read(line + "\n");
    EXPECT_EQ(segments.size(), 1U);
    EXPECT_EQ(segments.at(0).motions.size(), 1U);
    return segments.at(0).motions.at(0);
  }

  /// What is said of a text, without the file's name.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const json::Error& error) {
      EXPECT_EQ(error.file(), path("matrix.csv"));
      return error.path() + ": " + error.reason();
    }
    return "accepted";
  }
};

TEST_F(MotionMatrix, IsOneSegmentALine) {
  const auto segments = read("1, 60, 0, 0\n3, 10.5, 15, 0\n");
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].duration_s, 60.0);
  EXPECT_TRUE(segments[0].motions.empty());
  EXPECT_EQ(segments[1].duration_s, 10.5);
  EXPECT_EQ(segments[1].motions[0].type, MotionType::TargetSpeed);
  EXPECT_EQ(segments[1].motions[0].final_speed_m_per_s, 15.0);
  EXPECT_TRUE(segments[1].keep_velocity_on_nose);
}

TEST_F(MotionMatrix, HoldsTheParametersOfEveryTypeInItsColumns) {
  EXPECT_EQ(motion("2,10,-5,0").speed_change_m_per_s, -5.0);
  EXPECT_EQ(motion("4,10,0.5,0").acceleration_m_per_s2, 0.5);
  EXPECT_EQ(motion("6,10,0.5,1").from_m_per_s2, 0.5);
  EXPECT_EQ(motion("6,10,0.5,1").to_m_per_s2, 1.0);
  EXPECT_EQ(motion("7,10,0,90").angle_deg, 90.0);
  EXPECT_EQ(motion("8,10,3,0").rate_deg_per_s, 3.0);
  EXPECT_EQ(motion("10,10,3,4").from_deg_per_s, 3.0);
  EXPECT_EQ(motion("10,10,3,4").to_deg_per_s, 4.0);
}

TEST_F(MotionMatrix, HasThePeriodOfARateBeforeItsAmplitudeAndThatOfAnAccelerationAfter) {
  EXPECT_EQ(motion("5,10,0.4,7").amplitude_m_per_s2, 0.4);
  EXPECT_EQ(motion("5,10,0.4,7").period_s, 7.0);
  for (const char* line : {"9,10,7,2", "91,10,7,2"}) {
    EXPECT_EQ(motion(line).period_s, 7.0);
    EXPECT_EQ(motion(line).amplitude_deg_per_s, 2.0);
  }
  EXPECT_EQ(motion("9,10,7,2").type, MotionType::SineRate);
  EXPECT_EQ(motion("91,10,7,2").type, MotionType::CosineRate);
}

TEST_F(MotionMatrix, MayHaveCommentsBlankLinesSpacesAndTheLineEndsOfOtherSystems) {
  EXPECT_EQ(read("# a table\r\n\r\n  1 ,\t60, 0,0\r\n # end\r\n8,1e1,3.0,0").size(), 2U);
}

TEST_F(MotionMatrix, RefusalsNameTheLine) {
  EXPECT_EQ(refusal("1,60,0,0\n\n3,10,15\n"), "line 3: has 3 columns; expected type, duration and two parameters");
  EXPECT_EQ(refusal("1,60,0,0,0\n"), "line 1: has 5 columns; expected type, duration and two parameters");
  EXPECT_EQ(refusal("1,60,zero,0\n"), "line 1: column 3 is 'zero'; expected a number");
  EXPECT_EQ(refusal("1,60,,0\n"), "line 1: column 3 is ''; expected a number");
  EXPECT_EQ(refusal("1,nan,0,0\n"), "line 1: column 2 is 'nan'; expected a number");
  EXPECT_EQ(refusal("11,60,0,0\n"),
            "line 1: column 1 is 11; expected one of the types 1, 2, 3, 4, 5, 6, 7, 8, 9, 91, 10");
  EXPECT_EQ(refusal("7.5,60,0,0\n").substr(0, 25), "line 1: column 1 is 7.5; ");
}

TEST_F(MotionMatrix, RefusesAParameterInAColumnThatItsTypeDoesNotUse) {
  EXPECT_EQ(refusal("7,10,90,0\n"), "line 1: column 3 is 90; turn has no parameter there: expected 0");
  EXPECT_EQ(refusal("1,10,0,1\n"), "line 1: column 4 is 1; uniform has no parameter there: expected 0");
}

TEST_F(MotionMatrix, HoldsTheLimitsOfTheScenarioFile) {
  EXPECT_EQ(refusal("1,0,0,0\n"), "line 1: duration_s is 0; expected 1e-06 to 1e+07");
  EXPECT_EQ(refusal("5,10,0.4,0\n"), "line 1: period_s is 0; expected 0.001 to 1e+07");
  std::string long_table;
  for (int i = 0; i < 101; ++i) long_table += "1,1e7,0,0\n";
  EXPECT_EQ(refusal(long_table), "line 101: brings the segments' total above 1e9 s");
}

TEST_F(MotionMatrix, RefusesMoreSegmentsThanAScenarioHolds) {
  std::string table;
  for (int i = 0; i < 100000; ++i) table += "1,1,0,0\n";
  EXPECT_EQ(read(table).size(), 100000U);
  EXPECT_EQ(refusal(table + "1,1,0,0\n"), "line 100001: is one segment too many; expected at most 100000");
}

TEST_F(MotionMatrix, RefusesAFileWithoutASegment) { EXPECT_EQ(refusal("# nothing\n"), ": holds no segment"); }

}  // namespace motion_matrix_test
}  // namespace inslab::scenario
