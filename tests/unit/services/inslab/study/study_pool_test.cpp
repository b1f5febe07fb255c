#include "inslab/services/inslab/study/study_pool.hpp"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "inslab/services/inslab/study/usage_watch.hpp"

namespace inslab::study {
namespace study_pool_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A pool whose run K takes K rests, and fails when it is in `fails`.
class Pool : public testing::Test {
 protected:
  class Run : public StudyPool::Process {
   public:
    Run(Pool& pool, std::uint32_t number) : pool_(pool), number_(number), ends_at_(pool.now_ + number) {
      pool_.most_at_once_ = std::max(pool_.most_at_once_, ++pool_.alive_);
      pool_.started_.push_back(number_);
    }
    ~Run() override { --pool_.alive_; }
    bool has_ended() override { return pool_.now_ >= ends_at_; }
    std::optional<std::string> failure() override {
      return pool_.fails_.count(number_) > 0 ? std::optional<std::string>("died") : std::nullopt;
    }

   private:
    Pool& pool_;
    std::uint32_t number_;
    std::uint32_t ends_at_;
  };

  void run(std::size_t jobs, std::deque<std::uint32_t> todo) {
    StudyPool pool(jobs, {[this](std::uint32_t number) { return std::make_unique<Run>(*this, number); },
                          [this](std::uint32_t number, const std::string& why) { failed_[number] = why; },
                          [this](std::size_t done, std::size_t) { shown_.push_back(done); }, [this] { ++now_; },
                          [this] { return now_ >= interrupted_at_; }});
    pool.run(std::move(todo));
  }

  std::uint32_t now_ = 0;
  std::uint32_t interrupted_at_ = 1000;
  int alive_ = 0;
  int most_at_once_ = 0;
  std::set<std::uint32_t> fails_;
  std::vector<std::uint32_t> started_;
  std::map<std::uint32_t, std::string> failed_;
  std::vector<std::size_t> shown_;
};

TEST_F(Pool, RunsSoManyAtATimeAndAllInTheEnd) {
  run(2, {3, 1, 1, 2, 5});
  EXPECT_THAT(started_, ElementsAre(3, 1, 1, 2, 5));
  EXPECT_EQ(most_at_once_, 2);
  EXPECT_EQ(alive_, 0);
  EXPECT_THAT(failed_, IsEmpty());
  EXPECT_EQ(shown_.back(), 5u);
}

TEST_F(Pool, GoesOnWhenOneDiesAndSaysWhich) {
  fails_ = {4};
  run(1, {2, 4, 3});
  EXPECT_THAT(started_, ElementsAre(2, 4, 3));
  EXPECT_THAT(failed_, ElementsAre(testing::Pair(4u, "died")));
}

TEST_F(Pool, EndsThoseUnderWayWhenItIsInterrupted) {
  interrupted_at_ = 3;
  run(2, {100, 100, 100});
  EXPECT_EQ(started_.size(), 2u);
  EXPECT_EQ(alive_, 0);
}

TEST(StudyCommandLine, OfOneRunNamesTheStudyAndTheRun) {
  StudyOptions options;
  options.scenario = "s.json";
  options.directory = "out";
  options.runs = 20;
  options.draw_start = true;
  EXPECT_THAT(options.arguments_of(7),
              ElementsAre("montecarlo", "s.json", "-o", "out", "-n", "20", "--one", "7", "--draw-start"));
}

TEST(UsageWatch, NamesWhatGrewFromTheFirstThirdToTheLast) {
  UsageWatch watch;
  watch.add("steady", 0.1, {100 << 20, 50});
  watch.add("steady", 0.9, {110 << 20, 55});
  watch.add("leaks", 0.1, {100 << 20, 50});
  watch.add("leaks", 0.2, {90 << 20, 50});
  watch.add("leaks", 0.9, {120 << 20, 90});
  EXPECT_THAT(watch.growth(), ElementsAre("leaks: its memory grew", "leaks: it holds more descriptors"));
  EXPECT_THAT(watch.text(), HasSubstr("most, first and last third"));
  EXPECT_FALSE(UsageWatch::wants(0.5));
}

}  // namespace study_pool_test
}  // namespace inslab::study
