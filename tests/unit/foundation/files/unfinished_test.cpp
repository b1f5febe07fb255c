#include "inslab/foundation/files/unfinished.hpp"

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "inslab/formats/tables/csv_writer.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

extern char** environ;

namespace inslab::files {
namespace unfinished_test {

class Unfinished : public test::TemporaryFolder {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path(""))) found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }

  /// In a process of its own, since nothing can be written afterwards.
  template <class Work>
  void in_a_child(Work work) {
    const pid_t child = fork();
    if (child == 0) {
      work();
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
};

TEST_F(Unfinished, ResultsThatAreNotWholeGoAndWholeOnesStay) {
  in_a_child([this] {
    write_file(path("whole"), "all of it");
    OutputFile half(path("half"));
    half.append(reinterpret_cast<const std::uint8_t*>("half"), 4);
    discard_unfinished();
    _exit(0);
  });
  EXPECT_EQ(names(), std::vector<std::string>{"whole"});
  EXPECT_EQ(contents(path("whole")), "all of it");
}

TEST_F(Unfinished, AResultThatWasThereBeforeStays) {
  put(path("result"), "before");
  in_a_child([this] {
    OutputFile again(path("result"));
    again.append(reinterpret_cast<const std::uint8_t*>("after"), 5);
    discard_unfinished();
    _exit(0);
  });
  EXPECT_EQ(names(), std::vector<std::string>{"result"});
  EXPECT_EQ(contents(path("result")), "before");
}

TEST_F(Unfinished, NoNameIsGivenAfterwards) {
  in_a_child([this] {
    OutputFile late(path("late"));
    std::thread([] { discard_unfinished(); }).join();
    std::thread([&late] { late.close(); }).detach();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    _exit(0);
  });
  EXPECT_TRUE(names().empty());
}

TEST_F(Unfinished, AnEmptyFolderOfResultsGoesWithThem) {
  in_a_child([this] {
    const UnfinishedFile folder(path("tables"));
    std::filesystem::create_directory(path("tables"));
    tables::CsvWriter table(path("tables/a.csv"), {{"a", "", tables::ColumnKind::Bool}});
    discard_unfinished();
    _exit(0);
  });
  EXPECT_TRUE(names().empty());
}

TEST_F(Unfinished, ProgramsOfOurOwnAreEnded) {
  in_a_child([] {
    std::string name = "sleep", argument = "60";
    char* argv[] = {name.data(), argument.data(), nullptr};
    pid_t program = 0;
    if (posix_spawnp(&program, "sleep", nullptr, nullptr, argv, environ) != 0) _exit(2);
    int status = 0;
    std::thread waits([&] { status = wait_for_program(program); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    discard_unfinished();
    siginfo_t ended{};
    waitid(P_PID, static_cast<id_t>(program), &ended, WEXITED | WNOWAIT);
    _exit(ended.si_status == SIGKILL ? 0 : 1);
  });
}

TEST(UnfinishedProgram, GivesItsWaitStatus) {
  std::string name = "sh", option = "-c", script = "exit 3";
  char* argv[] = {name.data(), option.data(), script.data(), nullptr};
  pid_t program = 0;
  ASSERT_EQ(posix_spawnp(&program, "sh", nullptr, nullptr, argv, environ), 0);
  const int status = wait_for_program(program);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

}  // namespace unfinished_test
}  // namespace inslab::files
