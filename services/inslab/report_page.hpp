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

/// What a report says.
struct ReportPage {
  std::string title;
  std::string description;
  std::string verdict;  ///< such as "PASS: 3 of 3 acceptance lines"; empty: nothing was asked for
  bool accepted = true;
  std::string text;  ///< the figures, as in the terminal
  std::vector<Figure> figures;
  std::vector<std::string> notes;  ///< what is not there, and why
};

/// The page as one HTML file that needs nothing else: no network, no script.
std::string html(const ReportPage& page);

}  // namespace inslab::cli
