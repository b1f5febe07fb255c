#include "inslab/foundation/host/finite_numbers.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace inslab::host {
namespace finite_numbers_test {

struct Line {
  double rate = 1.0;
  std::optional<double> at_s;
  std::string name;
};

/// What is wrong with the line; empty: nothing.
std::string error_of(const std::string& words, Line& line) {
  CLI::App app("test");
  CLI::App* command = app.add_subcommand("command");
  command->add_option("--rate", line.rate)->check(CLI::Range(0.01, 1000.0));
  command->add_option("--at", line.at_s);
  command->add_option("--name", line.name);
  expect_finite_numbers(app);
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(FiniteNumbers, AreExpectedOfEveryNumberOfEveryCommand) {
  Line line;
  for (const char* given : {"nan", "NaN", "-nan", "nan(1)"}) {
    EXPECT_EQ(error_of(std::string("command --rate=") + given, line),
              std::string("--rate: is ") + given + "; expected a finite number");
    EXPECT_EQ(error_of(std::string("command --at=") + given, line),
              std::string("--at: is ") + given + "; expected a finite number");
  }
  EXPECT_EQ(error_of("command --at=1e999", line), "--at: is 1e999; expected a finite number");
}

TEST(FiniteNumbers, AndWordsPass) {
  Line line;
  EXPECT_EQ(error_of("command --rate 2.5 --at=-1e3 --name nan", line), "");
  EXPECT_EQ(line.rate, 2.5);
  EXPECT_EQ(line.at_s, -1e3);
  EXPECT_EQ(line.name, "nan");
}

}  // namespace finite_numbers_test
}  // namespace inslab::host
