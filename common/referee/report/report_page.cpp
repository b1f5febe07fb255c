#include "inslab/referee/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/foundation/files/xml_text.hpp"

namespace inslab::report {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --text: #1b1f24; --soft: #57606a; --back: #ffffff; --line: #c8ced6; --band: #f3f5f8;
  --good: #1f7a33; --bad: #b3261e; --odd: #8a5a00; }
@media (prefers-color-scheme: dark) { :root { --text: #e6e9ed; --soft: #a3acb8; --back: #16191d; --line: #444b54;
  --band: #20252b; --good: #58c272; --bad: #ff7b72; --odd: #e0a94a; } figure svg { filter: invert(0.91) hue-rotate(180deg); } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--text); background: var(--back); max-width: 64rem;
  margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: 0.25rem; } h2 { font-size: 1.15rem; margin: 2rem 0 0.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.875rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25rem 0.45rem; border-bottom: 1px solid var(--line); text-align: right; vertical-align: bottom; }
th { font-weight: 600; color: var(--soft); } tbody tr:nth-child(even) { background: var(--band); }
td { white-space: nowrap; } .word { text-align: left; white-space: normal; }
td.word:first-child:not(.good):not(.bad) { min-width: 7rem; }
.good { color: var(--good); font-weight: 700; } .bad { color: var(--bad); font-weight: 700; }
.odd { color: var(--odd); font-weight: 700; } a { color: inherit; } .identity { font-size: 0.875rem; color: var(--soft);
  overflow-wrap: anywhere; }
figure { margin: 0; border: 1px solid var(--line); padding: 0.5rem; break-inside: avoid; }
figure svg { width: 100%; height: auto; display: block; } .narrow { display: none; }
@media screen and (max-width: 40rem) { .narrow { display: block; } .broad { display: none; } body { margin: 1rem auto; }
  figure { padding: 0.125rem; } }
figcaption, .caption { font-size: 0.875rem; color: var(--soft); padding: 0.25rem; margin: 0; }
.verdict { font-size: 1.15rem; font-weight: 700; border-left: 0.5rem solid var(--good); background: var(--band);
  padding: 0.5rem 0.75rem; }
.failed { border-color: var(--bad); }
@media print { :root { --text: #000000; --soft: #333333; --back: #ffffff; --line: #999999; --band: #ffffff; }
  body { max-width: none; margin: 0; } table { font-size: 7pt; } h2 { break-after: avoid; }
  figure svg { filter: none; } }
)";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// The <svg> element alone, named for readers of the screen, its identifiers distinct from other pictures'.
std::string inlined(const Figure& figure, const std::string& drawing, const std::string& prefix) {
  const std::size_t begin = drawing.find("<svg");
  std::string svg = begin == std::string::npos ? "" : drawing.substr(begin);
  if (svg.empty()) return svg;
  for (const char* quote : {"\"", "'"}) {
    replace_all(svg, std::string(" id=") + quote, std::string(" id =") + quote + prefix);
    replace_all(svg, std::string("xlink:href=") + quote + "#", std::string("href=") + quote + "#" + prefix);
  }
  replace_all(svg, " id =", " id=");
  replace_all(svg, "url(#", "url(#" + prefix);
  return svg.replace(0, 4,
                     "<svg role=\"img\" aria-label=\"" + files::xml_text(figure.title + ": " + figure.caption) + "\"");
}

std::string id_of(const std::string& id) { return id.empty() ? "" : " id=\"" + files::xml_text(id) + "\""; }

std::string drawings_of(const Figure& figure, std::size_t number) {
  const std::string prefix = "figure" + std::to_string(number) + "_";
  if (figure.narrow_svg.empty()) return inlined(figure, figure.svg, prefix);
  return "<div class=\"broad\">" + inlined(figure, figure.svg, prefix) + "</div><div class=\"narrow\">" +
         inlined(figure, figure.narrow_svg, prefix + "narrow_") + "</div>";
}

const char* class_of(const Cell& cell, bool is_word) {
  const Tone tone = cell.text == "PASS" ? Tone::Good : cell.text == "FAIL" ? Tone::Bad : cell.tone;
  switch (tone) {
    case Tone::Good:
      return is_word ? " class=\"word good\"" : " class=\"good\"";
    case Tone::Bad:
      return is_word ? " class=\"word bad\"" : " class=\"bad\"";
    case Tone::Odd:
      return is_word ? " class=\"word odd\"" : " class=\"odd\"";
    case Tone::Plain:
      break;
  }
  return is_word ? " class=\"word\"" : "";
}

std::string element_of(const Cell& cell, const char* element, bool is_word) {
  std::string text = files::xml_text(cell.text);
  if (!cell.link.empty()) text = fmt::format("<a href=\"#{}\">{}</a>", files::xml_text(cell.link), text);
  return fmt::format("<{0}{1}>{2}</{0}>", element, class_of(cell, is_word), text);
}

template <class Cells>
std::string row_of(const Cells& cells, const char* element, std::size_t words) {
  std::string row = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) row += element_of(cells[i], element, i < words);
  return row + "</tr>\n";
}

std::string table_of(const PageTable& table) {
  std::string out = fmt::format(
      "<h2{1}>{0}</h2>\n<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n"
      "<table>\n",
      files::xml_text(table.title), id_of(table.id));
  const bool has_head =
      std::any_of(table.head.begin(), table.head.end(), [](const std::string& t) { return !t.empty(); });
  if (has_head) out += "<thead>" + row_of(table.head, "th", table.words) + "</thead>\n";
  out += "<tbody>\n";
  for (const auto& row : table.rows) out += row_of(row, "td", table.words);
  out += "</tbody>\n</table>\n</div>\n";
  if (!table.caption.empty()) out += fmt::format("<p class=\"caption\">{}</p>\n", files::xml_text(table.caption));
  return out;
}

}  // namespace

std::string html(const ReportPage& page) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<main>\n<h1>{}</h1>\n<p>{}</p>\n",
      files::xml_text(page.title), kStyle, files::xml_text(page.title), files::xml_text(page.description));
  if (!page.verdict.empty()) {
    out +=
        fmt::format("<p class=\"verdict{}\">{}</p>\n", page.accepted ? "" : " failed", files::xml_text(page.verdict));
  }
  if (!page.worst.empty()) {
    out += fmt::format("<p><strong>Worst moment:</strong> {}.</p>\n", files::xml_text(page.worst));
  }
  if (!page.identity.empty()) out += fmt::format("<p class=\"identity\">{}</p>\n", files::xml_text(page.identity));
  for (const PageTable& table : page.tables) out += table_of(table);
  if (!page.notes.empty()) out += "<h2>Notes</h2>\n";
  for (const std::string& note : page.notes) out += fmt::format("<p>{}</p>\n", files::xml_text(note));
  for (std::size_t i = 0; i < page.figures.size(); ++i) {
    const Figure& figure = page.figures[i];
    out += fmt::format("<h2{}>{}</h2>\n<figure>{}<figcaption>{}</figcaption></figure>\n", id_of(figure.id),
                       files::xml_text(figure.title), drawings_of(figure, i), files::xml_text(figure.caption));
  }
  return out + "</main>\n</body>\n</html>\n";
}

}  // namespace inslab::report
