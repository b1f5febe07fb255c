#include "inslab/formats/exports/log_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <sstream>

#include "inslab/formats/log/log_channel.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/tables/csv_writer.hpp"
#include "inslab/formats/tables/hdf5_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/unit/formats/recordings/random_sample.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

// The HDF5 library leaks what it could not write to a full disk; the sanitizer's runtime asks this function.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace inslab::exports {
namespace log_export_test {

using ::testing::HasSubstr;

class LogExport : public test::TemporaryFolder {
 protected:
  static constexpr std::size_t kSamples = 2500;  // more than two HDF5 chunks of 1024 rows

  void SetUp() override {
    TemporaryFolder::SetUp();
    mcap::McapWriter writer(path("run.mcap"));
    writer.metadata("run", {{"scenario", "static"}, {"note", "a, \"quoted\" word"}});
    log::LogChannel<TruthState> truth(writer, "inslab/truth");
    log::LogChannel<ServiceStatus> status(writer, "inslab/service_status");
    test::RandomFields random(5);
    for (std::size_t k = 0; k < kSamples; ++k) {
      samples_.push_back(random.make<TruthState>());
      truth.write(samples_.back(), 0, k, k);
      if (k % 1000 == 0) status.write(random.make<ServiceStatus>(), 0, k, k);
    }
    writer.close();
  }

  std::vector<TruthState> samples_;
};

bool same_bits(double a, double b) { return std::isnan(a) ? std::isnan(b) : std::memcmp(&a, &b, sizeof(a)) == 0; }

TEST_F(LogExport, ALogFromBeforeTheTypesHadAVersionGivesTheSameRows) {
  {
    mcap::McapWriter writer(path("earlier.mcap"));
    const auto schema = writer.add_schema("inslab::TruthState", "omgidl", "module inslab { };");
    const auto channel = writer.add_channel(schema, "inslab/truth", "cdr", {});
    std::vector<std::uint8_t> bytes;
    for (std::size_t k = 0; k < kSamples; ++k) {
      wire::encode(samples_[k], bytes);
      writer.write(channel, 0, k, k, bytes.data(), bytes.size());
    }
    writer.close();
  }
  export_log(path("run.mcap"), ExportFormat::Csv, path("now"));
  const auto topics = export_log(path("earlier.mcap"), ExportFormat::Csv, path("earlier"));
  ASSERT_EQ(topics.size(), 1u);
  EXPECT_EQ(topics[0].rows, kSamples);
  EXPECT_EQ(contents(path("earlier/inslab_truth.csv")), contents(path("now/inslab_truth.csv")));
  std::size_t read = 0;
  log::for_each_sample<TruthState>(mcap::McapReader(path("earlier.mcap")), "inslab/truth",
                                   [&read](const TruthState&, std::uint64_t) {
                                     ++read;
                                     return true;
                                   });
  EXPECT_EQ(read, kSamples);
}

TEST_F(LogExport, CsvReadsBackToTheSameDoubles) {
  const auto topics = export_log(path("run.mcap"), ExportFormat::Csv, path("out"));
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[1].topic, "inslab/truth");
  EXPECT_EQ(topics[1].rows, kSamples);
  EXPECT_EQ(topics[1].place, path("out/inslab_truth.csv"));

  std::istringstream lines(contents(path("out/inslab_truth.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, testing::StartsWith("header.run_id,header.sequence_number,header.sim_time_ns,"));
  const std::vector<tables::Column> columns = tables::columns_of<TruthState>();
  tables::Row row;
  for (const TruthState& sample : samples_) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream cells(line);
    tables::fill_row(sample, row);
    for (const tables::Cell& cell : row) {
      std::string text;
      ASSERT_TRUE(std::getline(cells, text, ','));
      if (const double* value = std::get_if<double>(&cell)) {
        ASSERT_TRUE(same_bits(std::strtod(text.c_str(), nullptr), *value)) << text;
      }
      if (const std::uint64_t* value = std::get_if<std::uint64_t>(&cell)) {
        ASSERT_EQ(std::strtoull(text.c_str(), nullptr, 10), *value);
      }
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(LogExport, CsvKeepsTheMetadata) {
  export_log(path("run.mcap"), ExportFormat::Csv, path("out"));
  EXPECT_EQ(contents(path("out/metadata.csv")),
            "name,key,value\nrun,note,\"a, \"\"quoted\"\" word\"\nrun,scenario,static\n");
}

TEST_F(LogExport, Hdf5HoldsTheSameDoublesWithTheirUnit) {
  const auto topics = export_log(path("run.mcap"), ExportFormat::Hdf5, path("run.h5"));
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[1].place, "inslab/truth");

  const hid_t file = H5Fopen(path("run.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, "inslab/truth/v_n_m_per_s.y", H5P_DEFAULT);
  ASSERT_GE(dataset, 0);
  const hid_t space = H5Dget_space(dataset);
  ASSERT_EQ(H5Sget_simple_extent_npoints(space), static_cast<hssize_t>(kSamples));
  std::vector<double> values(kSamples);
  ASSERT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  for (std::size_t k = 0; k < kSamples; ++k) ASSERT_TRUE(same_bits(values[k], samples_[k].v_n.y())) << k;

  const hid_t attribute = H5Aopen(dataset, "unit", H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  std::string unit(H5Tget_size(type), ' ');
  H5Aread(attribute, type, unit.data());
  EXPECT_EQ(unit, "m/s");
  for (const auto& close : {H5Tclose(type), H5Aclose(attribute), H5Sclose(space), H5Dclose(dataset), H5Fclose(file)}) {
    EXPECT_GE(close, 0);
  }
}

TEST_F(LogExport, TakesTheTopicsAskedForAlone) {
  const auto topics = export_log(path("run.mcap"), ExportFormat::Csv, path("out"), {"inslab/service_status"});
  ASSERT_EQ(topics.size(), 1u);
  EXPECT_EQ(topics[0].rows, 3u);
  EXPECT_FALSE(std::filesystem::exists(path("out/inslab_truth.csv")));
}

TEST_F(LogExport, RefusesATopicThatIsNotThereAndNamesThoseThatAre) {
  try {
    export_log(path("run.mcap"), ExportFormat::Csv, path("out"), {"inslab/imu/0"});
    FAIL() << "exported a topic that is not there";
  } catch (const files::ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no topic inslab/imu/0; it has inslab/truth, inslab/service_status"));
  }
}

TEST_F(LogExport, LeavesOutForeignTypesAndDamagedMessagesAndSaysSo) {
  {
    mcap::McapWriter writer(path("odd.mcap"));
    const std::uint8_t bytes[] = {1, 2, 3};
    const auto foreign = writer.add_channel(writer.add_schema("other::Type", "omgidl", "?"), "other/topic", "cdr");
    writer.write(foreign, 0, 0, 0, bytes, sizeof(bytes));
    log::LogChannel<TruthState> truth(writer, "inslab/truth");
    truth.write(samples_[0], 0, 0, 0);
    writer.write(1, 1, 1, 1, bytes, sizeof(bytes));
    writer.close();
  }
  const auto topics = export_log(path("odd.mcap"), ExportFormat::Csv, path("out"));
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[0].rows, 1u);
  EXPECT_EQ(topics[0].unreadable, 1u);
  EXPECT_EQ(topics[1].place, "");
}

TEST_F(LogExport, TopicNamesCannotLeaveTheFolder) {
  {
    mcap::McapWriter writer(path("evil.mcap"));
    for (const char* topic : {"../../escape", "/", "a/b", "a_b", "metadata"}) {
      log::LogChannel<TruthState>(writer, topic).write(samples_[0], 0, 0, 0);
    }
    writer.close();
  }
  for (const auto& topic : export_log(path("evil.mcap"), ExportFormat::Csv, path("out"))) {
    EXPECT_EQ(std::filesystem::path(topic.place).parent_path(), path("out"));
    EXPECT_EQ(topic.rows, 1u);
  }
  EXPECT_EQ(export_log(path("evil.mcap"), ExportFormat::Hdf5, path("evil.h5")).size(), 5u);
}

TEST_F(LogExport, SaysWhichFileCannotBeWritten) {
  put(path("file"), "not a folder");
  EXPECT_THROW(export_log(path("run.mcap"), ExportFormat::Csv, path("file/out")), files::WriteError);
  try {
    export_log(path("run.mcap"), ExportFormat::Hdf5, path("nowhere/run.h5"));
    FAIL() << "wrote into a folder that is not there";
  } catch (const files::WriteError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nowhere/run.h5: cannot create"));
    EXPECT_THAT(error.what(), HasSubstr("No such file or directory"));
  }
}

class LogExportToAFullDisk : public LogExport {
 protected:
  void SetUp() override {
    LogExport::SetUp();
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = 300000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  void TearDown() override {
    setrlimit(RLIMIT_FSIZE, &before_);
    LogExport::TearDown();
  }
  void expect_error(ExportFormat format, const std::string& name) const {
    try {
      export_log(path("run.mcap"), format, path(name));
      FAIL() << "wrote more than fits";
    } catch (const files::WriteError& error) {
      EXPECT_THAT(error.what(), HasSubstr(path(name)));
      EXPECT_THAT(error.what(), HasSubstr("cannot write: File too large"));
    }
  }

 private:
  rlimit before_{};
};

TEST_F(LogExportToAFullDisk, CsvNamesFileAndReason) { expect_error(ExportFormat::Csv, "out"); }

TEST_F(LogExportToAFullDisk, Hdf5NamesFileAndReason) { expect_error(ExportFormat::Hdf5, "run.h5"); }

}  // namespace log_export_test
}  // namespace inslab::exports
