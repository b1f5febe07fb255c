#include "inslab/formats/recordings/recorded_errors_file.hpp"

#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/formats/log/log_channel.hpp"
#include "inslab/formats/recordings/recording_shelf.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/sha256.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::recordings {
namespace recorded_errors_file_test {

class RecordedErrorsFiles : public test::TemporaryFolder {
 protected:
  static RecordedErrors some(double hz) {
    RecordedErrors errors;
    errors.rate = time::Rate(hz);
    for (int k = 0; k < 50; ++k) errors.intervals.push_back({1e-6 * k, 1.0 / 3.0, -k * 1e-9, 0.1, k * 1e-3, -0.0});
    return errors;
  }
  template <class Work>
  static std::string refusal(const Work& work) {
    try {
      work();
    } catch (const files::ReadError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(RecordedErrorsFiles, ComeBackToTheBitWithTheirNotes) {
  for (const double hz : {200.0, 300.0, 1024.0}) {
    const std::string file = path("errors" + std::to_string(hz) + ".mcap");
    write_recorded_errors(file, some(hz), {{"method", "by hand"}});
    const RecordedErrorsFile read = read_recorded_errors(file);
    EXPECT_EQ(read.errors.rate.hz(), hz);
    EXPECT_EQ(read.errors.intervals, some(hz).intervals);
    EXPECT_EQ(read.notes.at("method"), "by hand");
  }
}

TEST_F(RecordedErrorsFiles, AnImusOwnLogIsNone) {
  {
    mcap::McapWriter log(path("imu.mcap"));
    log::LogChannel<ImuSample> channel(log, "inslab/imu/0");
    channel.write(ImuSample{}, 0, 0, 0);
    log.close();
  }
  EXPECT_EQ(refusal([&] { read_recorded_errors(path("imu.mcap")); }),
            path("imu.mcap") +
                ": does not say that it holds the errors of an IMU; expected what `inslab graft extract` "
                "writes");
}

TEST_F(RecordedErrorsFiles, AreFoundByNameAndHashAlone) {
  write_recorded_errors(path("errors.mcap"), some(200.0), {});
  const std::string hash = files::sha256_of_file(path("errors.mcap"));
  RecordingShelf shelf(path(""));
  EXPECT_EQ(shelf.find_imu("errors.mcap", hash)->intervals.size(), 50u);
  EXPECT_EQ(shelf.find_imu("errors.mcap", hash), shelf.find_imu("errors.mcap", hash));

  RecordingShelf fresh(path(""));
  const std::string other(64, '0');
  EXPECT_EQ(refusal([&] { fresh.find_imu("errors.mcap", other); }),
            path("errors.mcap") + ": has the SHA-256 " + hash + "; the profile names " + other);
  EXPECT_EQ(refusal([&] { fresh.find_imu("none.mcap", hash); }),
            path("none.mcap") + ": is not there; recordings are looked for in that folder on each host");
  for (const char* name : {"../errors.mcap", "/etc/passwd", "..", "a/errors.mcap", ""}) {
    EXPECT_NE(refusal([&] { fresh.find_imu(name, hash); }).find("is a path"), std::string::npos) << name;
  }
}

TEST_F(RecordedErrorsFiles, ThatEndTooSoonOrLackASampleAreRefused) {
  write_recorded_errors(path("errors.mcap"), some(200.0), {});
  RecordedErrors none;
  write_recorded_errors(path("none.mcap"), none, {});
  EXPECT_EQ(refusal([&] { read_recorded_errors(path("none.mcap")); }), path("none.mcap") + ": has no sample");
  {
    mcap::McapWriter log(path("gap.mcap"));
    log.metadata("recorded_errors", {{"rate_hz", "200"}});
    log::LogChannel<ImuSample> channel(log, "inslab/imu/0");
    ImuSample sample;
    for (const std::int64_t ns : {5'000'000, 15'000'000}) {
      sample.header.sim_time_ns = ns;
      channel.write(sample, 0, static_cast<std::uint64_t>(ns), 0);
    }
    log.close();
  }
  EXPECT_EQ(refusal([&] { read_recorded_errors(path("gap.mcap")); }),
            path("gap.mcap") + ": sample 2 ends at 0.015000 s; expected 0.010000 s: no gap at 200 Hz");
}

TEST(Sha256, IsThatOfTheStandard) {  // FIPS 180-4, examples of NIST's cryptographic standards page
  files::Sha256 empty, abc;
  EXPECT_EQ(empty.hexadecimal(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  abc.add("abc", 3);
  EXPECT_EQ(abc.hexadecimal(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace recorded_errors_file_test
}  // namespace inslab::recordings
