#pragma once

#include <string>
#include <vector>

namespace inslab::cli {

/// One picture of a page: a heading, what it shows in words, and the SVG text that gnuplot wrote.
struct Figure {
  std::string title;
  std::string caption;
  std::string svg;
};

/// Rows under a head; the first columns are words, the others are figures. Cells "PASS" and "FAIL" stand out.
struct PageTable {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::string caption = {};
  std::size_t words = 1;  ///< columns of words
};

/// What a report says, in the order in which it says it.
struct ReportPage {
  std::string title;
  std::string description;
  std::string verdict;  ///< such as "PASS: 3 of 3 acceptance lines"; empty: nothing was asked for
  bool accepted = true;
  std::vector<PageTable> tables;
  std::vector<Figure> figures;
  std::vector<std::string> notes;  ///< what is not there, and why
};

/// The page as one HTML file that needs nothing else: no network, no script.
std::string html(const ReportPage& page);

}  // namespace inslab::cli
