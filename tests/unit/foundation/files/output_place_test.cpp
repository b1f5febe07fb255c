#include "inslab/foundation/files/output_place.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "inslab/formats/tables/hdf5_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_file.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::files {
namespace output_place_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OutputPlaces : public test::TemporaryFolder {
 protected:
  void TearDown() override {
    set_output_rule(OutputRule::ReplaceAll);
    test::TemporaryFolder::TearDown();
  }
  std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(fs::path(path("x")).parent_path())) ++count;
    return count;
  }
};

TEST_F(OutputPlaces, AResultHasItsNameWhenItIsWholeAndWhatWasThereStaysUntilThen) {
  write_file(path("r.txt"), "old");
  {
    OutputFile file(path("r.txt"));
    file.append(reinterpret_cast<const std::uint8_t*>("ne"), 2);
    EXPECT_EQ(contents(path("r.txt")), "old");
    file.append(reinterpret_cast<const std::uint8_t*>("w"), 1);
    file.close();
  }
  EXPECT_EQ(contents(path("r.txt")), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputPlaces, HalfAResultIsNone) {
  write_file(path("r.txt"), "old");
  {
    OutputFile file(path("r.txt"));
    file.append(reinterpret_cast<const std::uint8_t*>("ha"), 2);
  }
  { tables::Hdf5Writer half(path("half.h5")); }
  EXPECT_EQ(contents(path("r.txt")), "old");
  EXPECT_EQ(files(), 1u) << "nothing else is left in the folder";
}

TEST_F(OutputPlaces, ALogGrowsUnderItsOwnName) {
  OutputFile file(path("run.log"), OutputFile::Kind::Log);
  file.append(reinterpret_cast<const std::uint8_t*>("ab"), 2);
  EXPECT_EQ(contents(path("run.log")), "ab");
}

TEST_F(OutputPlaces, ALogThatIsBeingWrittenIsNobodyElses) {
  const auto refuses = ThrowsMessage<OutputRefused>(HasSubstr("run.log: another process is writing to it"));
  {
    OutputFile file(path("run.log"), OutputFile::Kind::Log);
    file.append(reinterpret_cast<const std::uint8_t*>("ab"), 2);
    for (const OutputRule rule : {OutputRule::ReplaceAll, OutputRule::ReplaceResults}) {
      set_output_rule(rule);
      EXPECT_THAT([&] { OutputFile(path("run.log"), OutputFile::Kind::Log); }, refuses);
      EXPECT_THAT([&] { OutputFile(path("run.log"), std::uint64_t{0}); }, refuses);
    }
    EXPECT_THAT([&] { check_output(path("run.log")); }, refuses) << "with --overwrite too";
    file.append(reinterpret_cast<const std::uint8_t*>("c"), 1);
    EXPECT_EQ(contents(path("run.log")), "abc");
  }
  EXPECT_NO_THROW(OutputFile(path("run.log"), OutputFile::Kind::Log));
}

TEST_F(OutputPlaces, WhatIsThereIsKeptUnlessAskedForAndAnInputAlways) {
  write_file(path("r.txt"), "old");
  write_file(path("in.txt"), "input");
  { InputFile input(path("in.txt")); }
  fs::create_hard_link(path("in.txt"), path("hard.txt"));
  fs::create_symlink(path("in.txt"), path("soft.txt"));
  set_output_rule(OutputRule::KeepResults);
  EXPECT_THAT([&] { write_file(path("r.txt"), "new"); },
              ThrowsMessage<WriteError>(HasSubstr("r.txt: is there already and is kept; --overwrite replaces it")));
  for (const OutputRule rule : {OutputRule::KeepResults, OutputRule::ReplaceResults}) {
    set_output_rule(rule);
    for (const std::string& spelt : {path("in.txt"), path("hard.txt"), path("soft.txt"), path(".") + "/in.txt"}) {
      EXPECT_THAT([&] { write_file(spelt, "new"); },
                  ThrowsMessage<WriteError>(HasSubstr("is an input of this command and is not replaced")))
          << spelt;
      EXPECT_THAT([&] { OutputFile(spelt, OutputFile::Kind::Log); }, testing::Throws<WriteError>()) << spelt;
    }
  }
  EXPECT_EQ(contents(path("in.txt")), "input");
  write_file(path("r.txt"), "new");
  EXPECT_EQ(contents(path("r.txt")), "new") << "asked for";
}

TEST_F(OutputPlaces, FreshNamesAreNobodyElses) {
  const std::string first = fresh_file(path("runs/demo"), ".mcap"), second = fresh_file(path("runs/demo"), ".mcap");
  EXPECT_EQ(first, path("runs/demo.mcap"));
  EXPECT_EQ(second, path("runs/demo-2.mcap"));
  set_output_rule(OutputRule::KeepResults);
  EXPECT_NO_THROW(check_output(first)) << "an empty file is nobody's result";
}

TEST_F(OutputPlaces, AFolderThatIsNotThereIsNamed) {
  EXPECT_THAT([&] { write_file(path("nowhere/r.txt"), "x"); },
              ThrowsMessage<WriteError>(HasSubstr("nowhere/r.txt: cannot create")));
}

}  // namespace output_place_test
}  // namespace inslab::files
