#include "inslab/formats/mcap/mcap_unfinished.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/mcap/mcap_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::mcap {
namespace mcap_unfinished_test {

class UnfinishedMcap : public test::TemporaryFolder {
 protected:
  static constexpr std::uint32_t kMessages = 20;

  /// Messages `first` to `end` - 1, of eight bytes each, on two topics, a flush after every tenth.
  static void write(McapWriter& log, std::uint32_t first, std::uint32_t end) {
    const auto type = log.add_schema("type", "omgidl", "text");
    const std::uint16_t channels[] = {log.add_channel(type, "a", "cdr"), log.add_channel(type, "b", "cdr")};
    for (std::uint32_t k = first; k < end; ++k) {
      const std::uint8_t payload[8] = {static_cast<std::uint8_t>(k)};
      log.write(channels[k % 2], k, 1000 + k, 1000 + k, payload, sizeof(payload));
      if (k % 10 == 9) log.flush();
    }
  }

  /// What a writer killed after its last flush leaves.
  std::vector<char> left_by_a_kill() {
    McapWriter log(path("whole.mcap"));
    write(log, 0, kMessages);
    log.metadata("note", {{"key", "value"}});
    std::ifstream file(path("whole.mcap"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string cut_to(const std::vector<char>& bytes, std::size_t size) {
    std::ofstream(path("cut.mcap"), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
    return path("cut.mcap");
  }
};

TEST_F(UnfinishedMcap, WhereverItEndsTheLogGoesOnWithEveryWholeChunk) {
  const std::vector<char> bytes = left_by_a_kill();
  std::size_t begin = 0;  // of what a log needs at least: magic and header
  {
    const McapWriter empty(path("empty.mcap"));
    begin = static_cast<std::size_t>(empty.file_size());
  }
  for (std::size_t size = begin; size <= bytes.size(); ++size) {
    const std::string cut = cut_to(bytes, size);
    const UnfinishedLog unfinished = read_unfinished(cut);
    const auto kept = static_cast<std::uint32_t>(unfinished.statistics.message_count);
    ASSERT_EQ(kept % 10, 0u) << "cut to " << size;
    {
      McapWriter log(cut, {}, unfinished);
      write(log, kept, kMessages + 7);
      log.close();
    }
    const McapReader reader(cut);
    ASSERT_TRUE(reader.closed_properly());
    ASSERT_EQ(reader.channels().size(), 2u);
    std::uint32_t next = 0;
    reader.for_each([&](const Message& message) {
      EXPECT_EQ(message.sequence, next);
      EXPECT_EQ(message.data[0], next);
      ++next;
      return true;
    });
    ASSERT_EQ(next, kMessages + 7) << "cut to " << size;
    ASSERT_EQ(reader.statistics().message_count, kMessages + 7);
  }
}

TEST_F(UnfinishedMcap, KeepsItsMetadata) {
  const std::string cut = cut_to(left_by_a_kill(), left_by_a_kill().size());
  { McapWriter log(cut, {}, read_unfinished(cut)); }
  const McapReader reader(cut);
  ASSERT_EQ(reader.metadata().size(), 1u);
  EXPECT_EQ(reader.metadata()[0].values.at("key"), "value");
}

/// Whatever came behind, an end included.
TEST_F(UnfinishedMcap, GoesOnFromWhereItWasKnownToEnd) {
  std::uint64_t known_size = 0;
  {
    McapWriter log(path("longer.mcap"));
    write(log, 0, 7);
    log.flush();
    known_size = log.file_size();
    write(log, 7, kMessages);
    log.metadata("note", {{"key", "value"}});
    log.close();
  }
  const UnfinishedLog unfinished = read_unfinished(path("longer.mcap"), known_size);
  EXPECT_EQ(unfinished.statistics.message_count, 7u);
  {
    McapWriter log(path("longer.mcap"), {}, unfinished);
    write(log, 7, 9);
    log.close();
  }
  const McapReader reader(path("longer.mcap"));
  EXPECT_TRUE(reader.closed_properly());
  EXPECT_EQ(reader.statistics().message_count, 9u);
  EXPECT_TRUE(reader.metadata().empty());
}

TEST_F(UnfinishedMcap, RefusesALogThatWasClosed) {
  {
    McapWriter log(path("closed.mcap"));
    write(log, 0, 3);
  }
  EXPECT_THAT([this] { read_unfinished(path("closed.mcap")); },
              testing::ThrowsMessage<files::ReadError>(testing::HasSubstr("a log that was not closed")));
}

TEST_F(UnfinishedMcap, RefusesWhatIsNoLog) {
  std::ofstream(path("text")) << "no log at all";
  EXPECT_THROW(read_unfinished(path("text")), files::ReadError);
}

}  // namespace mcap_unfinished_test
}  // namespace inslab::mcap
