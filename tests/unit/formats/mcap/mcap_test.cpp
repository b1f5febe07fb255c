#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <tuple>

#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/mcap/mcap_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::mcap {
namespace mcap_test {

using ::testing::HasSubstr;
using Order = McapReader::Order;

class McapLog : public test::TemporaryFolder {
 protected:
  struct Seen {
    std::uint16_t channel;
    std::uint32_t sequence;
    std::uint64_t log_time_ns;
    std::uint64_t publish_time_ns;
    std::string data;

    friend bool operator==(const Seen& a, const Seen& b) {
      return std::tie(a.channel, a.sequence, a.log_time_ns, a.publish_time_ns, a.data) ==
             std::tie(b.channel, b.sequence, b.log_time_ns, b.publish_time_ns, b.data);
    }
  };

  static McapWriter::Options small_chunks() {
    McapWriter::Options options;
    options.chunk_bytes = 1000;
    return options;
  }
  static void write(McapWriter& writer, const Seen& m) {
    writer.write(m.channel, m.sequence, m.log_time_ns, m.publish_time_ns,
                 reinterpret_cast<const std::uint8_t*>(m.data.data()), m.data.size());
  }
  static std::vector<Seen> read(const McapReader& reader, Order order = Order::File,
                                const std::set<std::uint16_t>& channels = {}) {
    std::vector<Seen> all;
    reader.for_each(
        [&](const Message& m) {
          all.push_back({m.channel_id, m.sequence, m.log_time_ns, m.publish_time_ns,
                         std::string(reinterpret_cast<const char*>(m.data), m.size)});
          return true;
        },
        order, channels);
    return all;
  }
  /// Two topics, a message of up to 99 bytes each 10 ns, in chunks of about ten.
  static std::vector<Seen> fill(McapWriter& writer, std::uint32_t count) {
    const auto schema = writer.add_schema("inslab::Some", "omgidl", "module inslab { struct Some { double x; }; };");
    writer.add_channel(schema, "inslab/a", "cdr");
    writer.add_channel(schema, "inslab/b", "cdr", {{"unit", "car1"}});
    std::mt19937 engine(7);
    std::vector<Seen> all;
    for (std::uint32_t k = 0; k < count; ++k) {
      std::string data(engine() % 100, ' ');
      for (char& c : data) c = static_cast<char>(engine());
      all.push_back({static_cast<std::uint16_t>(k % 2), k / 2, 10 * k + 5, 10 * k + 6, data});
      write(writer, all.back());
    }
    return all;
  }
};

TEST_F(McapLog, GivesBackWhatWasWritten) {
  McapWriter writer(path("run.mcap"), small_chunks());
  writer.metadata("run", {{"scenario", "static"}, {"seed", "1"}});
  const std::vector<Seen> written = fill(writer, 200);
  writer.close();

  const McapReader reader(path("run.mcap"));
  EXPECT_TRUE(reader.closed_properly());
  EXPECT_EQ(reader.ending(), "");
  EXPECT_EQ(reader.library(), "inslab");
  EXPECT_EQ(read(reader), written);
  EXPECT_EQ(read(reader, Order::LogTime), written);
  ASSERT_EQ(reader.schemas().size(), 1u);
  EXPECT_EQ(reader.schemas().at(1).name, "inslab::Some");
  EXPECT_EQ(reader.schemas().at(1).encoding, "omgidl");
  ASSERT_EQ(reader.channels().size(), 2u);
  EXPECT_EQ(reader.channels().at(1).topic, "inslab/b");
  EXPECT_EQ(reader.channels().at(1).metadata.at("unit"), "car1");
  ASSERT_EQ(reader.metadata().size(), 1u);
  EXPECT_EQ(reader.metadata()[0].name, "run");
  EXPECT_EQ(reader.metadata()[0].values.at("scenario"), "static");
}

TEST_F(McapLog, CountsWhatItHolds) {
  McapWriter writer(path("run.mcap"), small_chunks());
  fill(writer, 201);
  writer.close();

  const Statistics statistics = McapReader(path("run.mcap")).statistics();
  EXPECT_EQ(statistics.message_count, 201u);
  EXPECT_EQ(statistics.channel_message_counts.at(0), 101u);
  EXPECT_EQ(statistics.channel_message_counts.at(1), 100u);
  EXPECT_EQ(statistics.message_start_time_ns, 5u);
  EXPECT_EQ(statistics.message_end_time_ns, 2005u);
  EXPECT_GT(statistics.chunk_count, 5u);
}

TEST_F(McapLog, WithoutMessagesOpensAndHasTheTopics) {
  McapWriter writer(path("run.mcap"));
  fill(writer, 0);
  writer.close();

  const McapReader reader(path("run.mcap"));
  EXPECT_TRUE(reader.closed_properly());
  EXPECT_EQ(reader.channels().size(), 2u);
  EXPECT_TRUE(read(reader).empty());
}

TEST_F(McapLog, TakesAMessageLargerThanAChunkAndAnEmptyOne) {
  McapWriter writer(path("run.mcap"), small_chunks());
  fill(writer, 0);
  const std::vector<Seen> written{{0, 1, 1, 1, std::string(5000, 'x')}, {0, 2, 2, 2, ""}, {1, 3, 3, 3, "y"}};
  for (const Seen& m : written) write(writer, m);
  writer.close();

  EXPECT_EQ(read(McapReader(path("run.mcap"))), written);
}

TEST_F(McapLog, LogTimeOrderMergesOverlappingChunks) {
  McapWriter writer(path("run.mcap"), small_chunks());
  fill(writer, 0);
  std::vector<Seen> written;
  std::mt19937 engine(3);
  for (std::uint32_t k = 0; k < 500; ++k) {
    // Up to 40 messages late: several chunks overlap, and equal times occur.
    written.push_back({static_cast<std::uint16_t>(k % 2), k, 1000 + k - engine() % 40, 0, std::string(50, 'z')});
    write(writer, written.back());
  }
  writer.close();

  const McapReader reader(path("run.mcap"));
  EXPECT_EQ(read(reader, Order::File), written);
  std::stable_sort(written.begin(), written.end(),
                   [](const Seen& a, const Seen& b) { return a.log_time_ns < b.log_time_ns; });
  EXPECT_EQ(read(reader, Order::LogTime), written);
}

TEST_F(McapLog, GivesTheTopicsAskedForAlone) {
  McapWriter writer(path("run.mcap"), small_chunks());
  std::vector<Seen> written = fill(writer, 100);
  writer.close();

  written.erase(std::remove_if(written.begin(), written.end(), [](const Seen& m) { return m.channel != 1; }),
                written.end());
  const McapReader reader(path("run.mcap"));
  EXPECT_EQ(read(reader, Order::File, {1}), written);
  EXPECT_EQ(read(reader, Order::LogTime, {1}), written);
}

TEST_F(McapLog, StopsWhenTheVisitorHasEnough) {
  McapWriter writer(path("run.mcap"), small_chunks());
  fill(writer, 100);
  writer.close();

  int calls = 0;
  McapReader(path("run.mcap")).for_each([&](const Message&) { return ++calls < 3; });
  EXPECT_EQ(calls, 3);
}

TEST_F(McapLog, OfAKilledWriterHoldsEverythingUpToTheLastFlush) {
  McapWriter writer(path("run.mcap"), small_chunks());
  writer.metadata("run", {{"scenario", "static"}});
  std::vector<Seen> written = fill(writer, 100);
  writer.flush();
  write(writer, {0, 999, 9999, 9999, "still in memory"});

  // The file as another process sees it at this moment is what SIGKILL would leave.
  const McapReader reader(path("run.mcap"));
  EXPECT_FALSE(reader.closed_properly());
  EXPECT_THAT(reader.ending(), HasSubstr("did not close"));
  EXPECT_EQ(read(reader), written);
  EXPECT_EQ(read(reader, Order::LogTime), written);
  EXPECT_EQ(reader.statistics().message_count, 100u);
  EXPECT_EQ(reader.statistics().channel_message_counts.at(0), 50u);
  EXPECT_EQ(reader.channels().size(), 2u);
  EXPECT_EQ(reader.metadata().size(), 1u);
}

TEST_F(McapLog, CutAnywhereGivesAllMessagesOfItsWholeChunks) {
  McapWriter writer(path("run.mcap"), small_chunks());
  const std::vector<Seen> written = fill(writer, 60);
  writer.close();
  const std::string whole = contents(path("run.mcap"));

  std::size_t most = 0;
  for (std::size_t size = 40; size < whole.size(); ++size) {
    put(path("cut.mcap"), whole.substr(0, size));
    const McapReader reader(path("cut.mcap"));
    EXPECT_FALSE(reader.closed_properly()) << size;
    const std::vector<Seen> seen = read(reader);
    ASSERT_GE(seen.size(), most) << size;
    ASSERT_TRUE(std::equal(seen.begin(), seen.end(), written.begin())) << size;
    most = seen.size();
  }
  EXPECT_EQ(most, written.size());
}

TEST_F(McapLog, WithAnyByteChangedNeverCrashesTheReader) {
  McapWriter writer(path("run.mcap"), small_chunks());
  fill(writer, 40);
  writer.metadata("run", {{"scenario", "static"}});
  writer.close();
  const std::string whole = contents(path("run.mcap"));

  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      put(path("bad.mcap"), damaged);
      try {
        const McapReader reader(path("bad.mcap"));
        read(reader, Order::File);
        read(reader, Order::LogTime);
      } catch (const files::ReadError& error) {
        EXPECT_THAT(error.what(), HasSubstr("bad.mcap"));
        ++refused;
      }
    }
  }
  // Message indexes and the unused statistics may change unseen; the messages themselves carry a CRC.
  EXPECT_GT(refused, static_cast<int>(whole.size()));
}

TEST_F(McapLog, ChangedInAMessageIsRefusedWithFilePlaceAndReason) {
  McapWriter writer(path("run.mcap"), small_chunks());
  fill(writer, 40);
  writer.close();
  std::string bytes = contents(path("run.mcap"));
  const std::size_t compression = bytes.find("zstd");
  bytes[compression + 100] = static_cast<char>(bytes[compression + 100] ^ 0x10);
  put(path("bad.mcap"), bytes);
  try {
    read(McapReader(path("bad.mcap")));
    FAIL() << "read a damaged chunk";
  } catch (const files::ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bad.mcap: chunk at byte "));
  }
}

TEST_F(McapLog, ThatClaimsAHugeChunkIsRefused) {
  McapWriter::Options options;
  options.chunk_bytes = 1 << 22;
  McapWriter writer(path("run.mcap"), options);
  fill(writer, 0);
  write(writer, {0, 0, 0, 0, std::string(3 << 20, ' ')});
  writer.close();

  McapReader::Options limits;
  limits.max_chunk_bytes = 1 << 20;
  EXPECT_THROW(read(McapReader(path("run.mcap"), limits)), files::ReadError);
}

TEST_F(McapLog, ReaderRefusesWhatIsNoLog) {
  put(path("text.mcap"), "time,x\n0,1\n");
  put(path("empty.mcap"), "");
  EXPECT_THROW(McapReader(path("text.mcap")), files::ReadError);
  EXPECT_THROW(McapReader(path("empty.mcap")), files::ReadError);
  EXPECT_THROW(McapReader(path("missing.mcap")), files::ReadError);
  EXPECT_THROW(McapReader(path("")), files::ReadError);
}

TEST_F(McapLog, RefusesUnknownSchemasAndChannels) {
  McapWriter writer(path("run.mcap"));
  EXPECT_THROW(writer.add_channel(3, "inslab/a", "cdr"), std::out_of_range);
  EXPECT_THROW(write(writer, {0, 0, 0, 0, "x"}), std::out_of_range);
}

TEST_F(McapLog, IsTheSameBytesForTheSameMessages) {
  for (const char* name : {"one.mcap", "two.mcap"}) {
    McapWriter writer(path(name), small_chunks());
    fill(writer, 100);
    writer.close();
  }
  EXPECT_EQ(contents(path("one.mcap")), contents(path("two.mcap")));
}

}  // namespace mcap_test
}  // namespace inslab::mcap
