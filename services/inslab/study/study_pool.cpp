#include "inslab/services/inslab/study/study_pool.hpp"

#include "inslab/services/inslab/live/child_processes.hpp"

namespace inslab::study {

void StudyPool::run(std::deque<std::uint32_t> todo) {
  const std::size_t all = todo.size();
  while ((!todo.empty() || !active_.empty()) && !work_.interrupted()) {
    for (; !todo.empty() && active_.size() < jobs_; todo.pop_front()) {
      active_.push_back({todo.front(), work_.start(todo.front())});
    }
    work_.rest();
    collect();
    show(all - todo.size() - active_.size(), all);
  }
  active_.clear();  // ends those that still run
}

void StudyPool::collect() {
  for (auto entry = active_.begin(); entry != active_.end();) {
    if (!entry->process->has_ended()) {
      ++entry;
      continue;
    }
    if (const auto why = entry->process->failure()) work_.failed(entry->run, *why);
    entry = active_.erase(entry);
  }
}

void StudyPool::show(std::size_t done, std::size_t all) {
  const std::size_t tenth = done * 10 / all;
  if (tenth == shown_) return;
  shown_ = tenth;
  work_.progress(done, all);
}

std::vector<std::string> StudyOptions::arguments_of(std::uint32_t run) const {
  std::vector<std::string> words{"montecarlo", scenario,           "-o", directory, "-n", std::to_string(runs),
                                 "--one",      std::to_string(run)};
  if (!parameters.empty()) words.insert(words.end(), {"--parameters", parameters});
  if (draw_start) words.emplace_back("--draw-start");
  return words;
}

std::unique_ptr<StudyPool::Process> study_process(const std::vector<std::string>& arguments) {
  class Child : public StudyPool::Process {
   public:
    explicit Child(const std::vector<std::string>& words) { children_.start("inslab-study", words); }
    bool has_ended() override {
      children_.poll();
      return children_.all_ended();
    }
    std::optional<std::string> failure() override { return children_.failure(); }

   private:
    live::ChildProcesses children_;
  };
  return std::make_unique<Child>(arguments);
}

}  // namespace inslab::study
