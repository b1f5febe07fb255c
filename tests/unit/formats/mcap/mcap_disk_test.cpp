#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/mcap/mcap_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::mcap {
namespace mcap_disk_test {

using ::testing::HasSubstr;

/// A log whose disk is full after 200 kB: a limit on the size of files stands in for the full disk.
class McapOnAFullDisk : public test::TemporaryFolder {
 protected:
  static constexpr rlim_t kLimit = 200000;

  void SetUp() override {
    TemporaryFolder::SetUp();
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    set_limit(kLimit);
  }
  void TearDown() override {
    set_limit(before_.rlim_cur);
    TemporaryFolder::TearDown();
  }
  void set_limit(rlim_t bytes) const {
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  static McapWriter::Options options() {
    McapWriter::Options options;
    options.chunk_bytes = 30000;
    return options;
  }
  /// Writes 1000 messages of 1000 bytes that do not compress; returns how many errors were thrown, and the last one.
  static int overfill(McapWriter& writer, std::string& message) {
    const auto channel = writer.add_channel(writer.add_schema("x", "omgidl", "y"), "inslab/a", "cdr");
    std::uint32_t noise = 1;
    int errors = 0;
    for (std::uint32_t k = 0; k < 1000; ++k) {
      std::vector<std::uint8_t> data(1000);
      for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>((noise = noise * 1664525 + 1013904223) >> 24);
      try {
        writer.write(channel, k, k, k, data.data(), data.size());
      } catch (const files::WriteError& error) {
        message = error.what();
        ++errors;
      }
    }
    return errors;
  }

 private:
  rlimit before_{};
};

TEST_F(McapOnAFullDisk, TheErrorComesOnceWithFileAndReason) {
  McapWriter writer(path("run.mcap"), options());
  std::string message;
  EXPECT_EQ(overfill(writer, message), 1);
  EXPECT_THAT(message, HasSubstr("run.mcap: cannot write: File too large"));
  EXPECT_TRUE(writer.failed());
  EXPECT_NO_THROW(writer.flush());
  EXPECT_NO_THROW(writer.close());
}

TEST_F(McapOnAFullDisk, WhatWasWrittenStaysReadableAndTheLogSaysWhatIsMissing) {
  McapWriter writer(path("run.mcap"), options());
  std::string message;
  overfill(writer, message);
  writer.close();

  const McapReader reader(path("run.mcap"));
  std::uint32_t next = 0;
  reader.for_each([&](const Message& m) {
    EXPECT_EQ(m.sequence, next++);
    return true;
  });
  // The last whole chunk ends less than a chunk before the limit.
  EXPECT_GT(next, 160u);
  ASSERT_EQ(reader.metadata().size(), 1u);
  EXPECT_EQ(reader.metadata()[0].name, "write_error");
  EXPECT_THAT(reader.metadata()[0].values.at("reason"), HasSubstr("File too large"));
  // The message whose write() threw was not taken either.
  EXPECT_EQ(reader.metadata()[0].values.at("messages_lost"), std::to_string(1000 - next));
}

TEST_F(McapOnAFullDisk, EndsWithAWholeRecordEvenWhenItCannotBeClosed) {
  std::string message;
  {
    McapWriter writer(path("run.mcap"), options());
    overfill(writer, message);
    set_limit(writer.file_size());
    writer.close();
  }
  const McapReader reader(path("run.mcap"));
  EXPECT_FALSE(reader.closed_properly());
  EXPECT_THAT(reader.ending(), HasSubstr("did not close"));
  EXPECT_GT(reader.statistics().message_count, 160u);
}

TEST(McapOnAMissingDisk, NamesFileAndReason) {
  try {
    McapWriter writer("/nonexistent/run.mcap");
    FAIL() << "created a file in a folder that is not there";
  } catch (const files::WriteError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/run.mcap: cannot create: No such file or directory");
  }
}

TEST(McapOnAMissingDisk, FullDeviceIsReportedAtOnce) {
  // /dev/full answers every write with ENOSPC.
  try {
    McapWriter writer("/dev/full");
    FAIL() << "wrote to a full device";
  } catch (const files::WriteError& error) {
    EXPECT_THAT(error.what(), HasSubstr("No space left on device"));
  }
}

}  // namespace mcap_disk_test
}  // namespace inslab::mcap
