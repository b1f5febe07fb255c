#include "inslab/formats/log/log_info_text.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <sstream>

#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::log {
namespace {

constexpr std::size_t kRunsShown = 3;
constexpr std::size_t kGapsShown = 10;
constexpr std::size_t kLongestValue = 100;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[512];
  std::snprintf(text, sizeof(text), pattern, values...);
  return text;
}

std::string seconds_text(const std::optional<std::int64_t>& time_ns) {
  return time_ns ? format("%.3f", time::to_seconds(*time_ns)) : "-";
}

/// First line, not too long: metadata may be whole files.
std::string shortened(const std::string& value) {
  const std::string line = value.substr(0, value.find('\n'));
  if (line.size() == value.size() && line.size() <= kLongestValue) return text::shown(value);
  return text::shown(text::cut(line, kLongestValue)) + "... (" + std::to_string(value.size()) + " bytes)";
}

/// A record with a name is known by it; what it holds as JSON is for programs.
void record_text(const mcap::Metadata& record, std::ostream& out) {
  const auto name = record.values.find("name");
  if (name != record.values.end()) {
    out << shortened(record.name) << ": " << shortened(name->second) << "\n";
    return;
  }
  for (const auto& [key, value] : record.values) {
    if (key != "json") out << shortened(record.name) << "." << shortened(key) << ": " << shortened(value) << "\n";
  }
}

void head_text(const LogInfo& info, std::ostream& out) {
  out << info.path << ": " << format("%.1f MB", static_cast<double>(info.file_size) * 1e-6) << ", "
      << info.message_count << " messages in " << info.chunk_count << " chunks, written by "
      << text::shown(info.library) << "\n";
  out << (info.closed_properly ? "closed properly" : "NOT closed properly: " + info.ending) << "\n";
  for (std::size_t i = 0; i < info.run_ids.size() && i < kRunsShown; ++i) {
    out << "run " << info.run_ids[i] << "\n";
  }
  if (info.run_ids.size() > kRunsShown) out << "and " << info.run_ids.size() - kRunsShown << " more runs\n";
  for (const auto& record : info.metadata) record_text(record, out);
}

void topics_text(const LogInfo& info, std::ostream& out) {
  std::size_t width = 5;
  for (const TopicInfo& topic : info.topics) width = std::max(width, topic.topic.size());
  const int topic_width = static_cast<int>(std::min<std::size_t>(width, 48));
  out << "\n"
      << format("%-*s  %-27s %10s %10s %12s %12s %8s %6s %6s\n", topic_width, "topic", "type", "count", "rate Hz",
                "first s", "last s", "missing", "dupl", "order");
  for (const TopicInfo& topic : info.topics) {
    const auto number = [&](std::uint64_t value) { return topic.is_numbered ? std::to_string(value) : "-"; };
    const std::string rate = topic.rate_hz ? format("%.3f", *topic.rate_hz) : "-";
    out << format("%-*s  %-27s %10" PRIu64 " %10s %12s %12s %8s %6s %6s\n", topic_width, shortened(topic.topic).c_str(),
                  shortened(topic.type).c_str(), topic.count, rate.c_str(),
                  seconds_text(topic.first_sim_time_ns).c_str(), seconds_text(topic.last_sim_time_ns).c_str(),
                  number(topic.missing).c_str(), number(topic.duplicates).c_str(), number(topic.out_of_order).c_str());
  }
}

void faults_text(const LogInfo& info, std::ostream& out) {
  for (const TopicInfo& topic : info.topics) {
    if (topic.unreadable > 0) {
      out << "\n" << shortened(topic.topic) << ": " << topic.unreadable << " messages are not " << topic.type << "\n";
    }
    if (topic.gaps.empty()) continue;
    out << "\n" << shortened(topic.topic) << ": " << topic.gaps.size() << " gaps\n";
    for (std::size_t i = 0; i < topic.gaps.size() && i < kGapsShown; ++i) {
      const SequenceGap& gap = topic.gaps[i];
      out << format("  %" PRIu64 " missing: sequence %" PRIu64 " to %" PRIu64 ", after %.3f s\n", gap.count(),
                    gap.first, gap.last, time::to_seconds(gap.after_sim_time_ns));
    }
    if (topic.gaps.size() > kGapsShown) out << "  and " << topic.gaps.size() - kGapsShown << " more\n";
  }
}

}  // namespace

std::string text_of(const LogInfo& info) {
  std::ostringstream out;
  head_text(info, out);
  topics_text(info, out);
  faults_text(info, out);
  return out.str();
}

}  // namespace inslab::log
