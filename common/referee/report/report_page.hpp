#pragma once

#include <string>
#include <utility>
#include <vector>

namespace inslab::report {

/// One picture of a page: a heading, what it shows in words, and the SVG texts that gnuplot wrote.
struct Figure {
  std::string title;
  std::string caption;
  std::string svg;
  std::string narrow_svg = {};  ///< drawn for a narrow screen, which shows it in place of the other; empty: none
  std::string id = {};          ///< by which a cell links to it; empty: none
};

/// How a cell stands out.
enum class Tone { Plain, Good, Bad, Odd };

/// One cell of a table. The texts "PASS" and "FAIL" are good and bad by themselves.
struct Cell {
  // Implicit, so that rows of texts read as such.
  // NOLINTNEXTLINE(google-explicit-constructor)
  Cell(std::string cell_text, Tone cell_tone = Tone::Plain, std::string cell_link = {})
      : text(std::move(cell_text)), tone(cell_tone), link(std::move(cell_link)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Cell(const char* cell_text) : text(cell_text) {}

  std::string text;
  Tone tone = Tone::Plain;
  std::string link;  ///< the id of a figure or table of the page; empty: none
};

/// Rows under a head; the first columns are words, the others are figures.
struct PageTable {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<Cell>> rows;
  std::string caption = {};
  std::size_t words = 1;  ///< columns of words
  std::string id = {};    ///< by which a cell links to it; empty: none
};

/// What a report says, in the order in which it says it.
struct ReportPage {
  std::string title;
  std::string description;
  std::string verdict;  ///< such as "PASS: 3 of 3 acceptance lines"; empty: nothing was asked for
  bool accepted = true;
  std::string worst = {};     ///< the worst moment and what was going on
  std::string identity = {};  ///< which run this is of
  std::vector<PageTable> tables;
  std::vector<Figure> figures;
  std::vector<std::string> notes;  ///< what is not there, and why
};

/// The page as one HTML file that needs nothing else: no network, no script.
std::string html(const ReportPage& page);

}  // namespace inslab::report
