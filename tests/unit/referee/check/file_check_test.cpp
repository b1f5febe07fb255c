#include "inslab/referee/check/file_check.hpp"

#include <gmock/gmock.h>

#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/referee/check/file_kind.hpp"
#include "inslab/referee/check/trajectory_check.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::check {
namespace file_check_test {

using testing::HasSubstr;
using Form = FileKind::Form;

class CheckedFile : public test::TemporaryFolder {
 protected:
  std::string file(const std::string& text) const {
    put(path("file"), text);
    return path("file");
  }
  FileCheck check(const std::string& text, const std::string& kind = "") const {
    CheckOptions options;
    options.file = file(text);
    options.kind = kind;
    return check_file(options);
  }
};

TEST_F(CheckedFile, IsRecognisedByItsContent) {
  EXPECT_EQ(file_kind(file("{}")).form, Form::Document);
  EXPECT_EQ(file_kind(file("\x89MCAP0\r\n")).form, Form::Log);
  EXPECT_EQ(file_kind(file("time_s,gyro_x_rad_per_s\n0,0\n")).form, Form::Recording);
  EXPECT_EQ(file_kind(file("time_s,latitude_deg,longitude_deg,height_m\n0,0,0,0\n")).form, Form::Trajectory);
  EXPECT_EQ(file_kind(file("1 2 3 4\n")).form, Form::MotionMatrix);
  EXPECT_EQ(file_kind(file("%RAWIMUSXA,1,2;3\n")).form, Form::NovatelLog);
  EXPECT_EQ(file_kind(file("words\n")).form, Form::Unknown);
}

TEST_F(CheckedFile, ThatIsEmptyOrUnknownIsAnError) {
  EXPECT_THROW(check(""), files::ReadError);
  EXPECT_THROW(check("words\n"), files::ReadError);
}

TEST_F(CheckedFile, OfTheKindThatIsAskedForIsGood) {
  const FileCheck checked = check(R"({"name": "still"})", "vibration");
  EXPECT_TRUE(checked.is_good);
  EXPECT_EQ(checked.text, path("file") + ": good: vibration profile 'still' for a sensor of the kind imu\n");
}

TEST_F(CheckedFile, WithNothingButANameIsOfNoKind) { EXPECT_THROW(check(R"({"name": "x"})"), json::Error); }

TEST_F(CheckedFile, OfRowsIsJudgedAsATrajectory) {
  const FileCheck checked = check(
      "time_s,latitude_deg,longitude_deg,height_m\n0,30,110,0\n1,30.00001,110,0\n2,30.00002,110,0\n50,30.00003,110,"
      "0\n");
  EXPECT_FALSE(checked.is_good);
  EXPECT_THAT(checked.text, HasSubstr("file: is a trajectory\n"));
  EXPECT_THAT(checked.text, HasSubstr("or raise max_gap_s"));
  EXPECT_THAT(checked.text, HasSubstr("NOT good\n"));
}

TEST_F(CheckedFile, OfRowsIsJudgedByTheLimitsThatAreGiven) {
  TrajectoryCheckOptions options;
  options.file = file(
      "time_s,latitude_deg,longitude_deg,height_m\n0,30,110,0\n1,30.00001,110,0\n2,30.00002,110,0\n50,30.00003,110,"
      "0\n");
  options.limits = {"max_gap_s=100"};
  EXPECT_TRUE(check_trajectory(options).is_good) << check_trajectory(options).text;
  options.limits = {"max_gap_s"};
  EXPECT_THROW(check_trajectory(options), json::Error);
  options.limits = {"no_such_limit=1"};
  EXPECT_THROW(check_trajectory(options), json::Error);
}

}  // namespace file_check_test
}  // namespace inslab::check
