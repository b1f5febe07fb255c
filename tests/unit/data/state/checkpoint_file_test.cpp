#include "inslab/data/state/checkpoint_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

namespace inslab::state {
namespace checkpoint_file_test {

using Bytes = std::vector<std::uint8_t>;

class Checkpoint : public testing::Test {
 protected:
  Checkpoint() { std::filesystem::remove(path_); }
  ~Checkpoint() override { std::filesystem::remove(path_); }

  /// Changes one byte of the file, as a process does that is killed while it writes.
  void spoil(std::streamoff at) {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const int before = file.get();
    file.seekp(at);
    file.put(static_cast<char>(before ^ 0x55));
  }

  std::string path_ = (std::filesystem::temp_directory_path() / ("inslab_checkpoint_" + std::to_string(getpid())));
};

TEST_F(Checkpoint, HasNothingAtFirst) { EXPECT_FALSE(CheckpointFile(path_).last()); }

TEST_F(Checkpoint, GivesBackTheNewestState) {
  {
    CheckpointFile file(path_);
    for (std::uint8_t i = 1; i <= 9; ++i) file.keep(Bytes(100u + i, i));
  }
  EXPECT_EQ(CheckpointFile(path_).last(), Bytes(109, 9));
}

TEST_F(Checkpoint, AHalfWrittenStateLeavesTheOneBeforeIt) {
  {
    CheckpointFile file(path_);
    file.keep(Bytes(100, 1));  // into the second slot
    file.keep(Bytes(100, 2));  // into the first
  }
  spoil(50);
  EXPECT_EQ(CheckpointFile(path_).last(), Bytes(100, 1));
}

TEST_F(Checkpoint, GoesOnAfterItWasOpenedAgain) {
  for (std::uint8_t i = 1; i <= 5; ++i) CheckpointFile(path_).keep(Bytes(10, i));
  EXPECT_EQ(CheckpointFile(path_).last(), Bytes(10, 5));
}

TEST_F(Checkpoint, GrowsForALargeStateAndGoesOn) {
  {
    CheckpointFile file(path_);
    file.keep(Bytes(100, 1));
    file.keep(Bytes(1'000'000, 2));
    EXPECT_FALSE(std::filesystem::exists(path_ + ".new"));
    file.keep(Bytes(1'000'001, 3));
  }
  EXPECT_EQ(CheckpointFile(path_).last(), Bytes(1'000'001, 3));
}

TEST_F(Checkpoint, ForWhichThereIsNoRoomLeavesTheOneBeforeIt) {
  CheckpointFile file(path_);
  file.keep(Bytes(100, 1));
  const auto room_for = [](rlim_t bytes) {
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  room_for(200'000);
  EXPECT_THROW(file.keep(Bytes(1'000'000, 2)), std::runtime_error);
  room_for(RLIM_INFINITY);
  std::signal(SIGXFSZ, before);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".new"));
  file.keep(Bytes(100, 3));
  file.keep(Bytes(1'000'000, 4));
}

TEST_F(Checkpoint, OfALivingProcessIsRefusedToAnother) {
  const CheckpointFile file(path_);
  try {
    const CheckpointFile other(path_);
    FAIL() << "two have it";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path_ + ": another process has it"), std::string::npos) << error.what();
  }
}

TEST_F(Checkpoint, OfGarbageIsNothing) {
  std::ofstream(path_) << std::string(300'000, 'x');
  EXPECT_FALSE(CheckpointFile(path_).last());
}

TEST_F(Checkpoint, BelongsToTheUserAlone) {
  const CheckpointFile file(path_);
  struct stat status {};
  ASSERT_EQ(stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0600u);
}

TEST_F(Checkpoint, InAFolderThatIsNotThereSaysWhich) {
  EXPECT_THROW(CheckpointFile("/no/such/folder/state"), std::runtime_error);
}

}  // namespace checkpoint_file_test
}  // namespace inslab::state
