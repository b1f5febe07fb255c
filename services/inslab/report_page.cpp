#include "services/inslab/report_page.hpp"

#include <fmt/format.h>

#include "io/xml_text.hpp"

namespace inslab::cli {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --text: #1b1f24; --back: #ffffff; --line: #c8ced6; }
@media (prefers-color-scheme: dark) { :root { --text: #e6e9ed; --back: #16191d; --line: #444b54; } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--text); background: var(--back); max-width: 62rem;
  margin: 2rem auto; padding: 0 1rem; }
pre { font-size: 0.8rem; line-height: 1.35; overflow-x: auto; border: 1px solid var(--line); padding: 0.75rem; }
figure { margin: 0; background: #ffffff; color: #1b1f24; border: 1px solid var(--line); padding: 0.5rem;
  break-inside: avoid; }
figure svg { width: 100%; height: auto; display: block; }
figcaption { font-size: 0.9rem; padding: 0.25rem 0.5rem; }
.verdict { font-weight: bold; border-left: 0.5rem solid #2f7d32; padding-left: 0.75rem; }
.failed { border-color: #b3261e; }
@media print { body { max-width: none; margin: 0; color: #000000; background: #ffffff; }
  pre { font-size: 6.5pt; white-space: pre; } h2 { break-after: avoid; } }
)";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// The <svg> element alone, named for readers of the screen, its identifiers distinct from other pictures'.
std::string inlined(const Figure& figure, std::size_t number) {
  const std::size_t begin = figure.svg.find("<svg");
  std::string svg = begin == std::string::npos ? "" : figure.svg.substr(begin);
  const std::string prefix = "figure" + std::to_string(number) + "_";
  for (const char* quote : {"\"", "'"}) {
    replace_all(svg, std::string(" id=") + quote, std::string(" id =") + quote + prefix);
    replace_all(svg, std::string("xlink:href=") + quote + "#", std::string("href=") + quote + "#" + prefix);
  }
  replace_all(svg, " id =", " id=");
  replace_all(svg, "url(#", "url(#" + prefix);
  return svg.replace(0, 4,
                     "<svg role=\"img\" aria-label=\"" + io::xml_text(figure.title + ": " + figure.caption) + "\"");
}

}  // namespace

std::string html(const ReportPage& page) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<main>\n<h1>{}</h1>\n<p>{}</p>\n",
      io::xml_text(page.title), kStyle, io::xml_text(page.title), io::xml_text(page.description));
  if (!page.verdict.empty()) {
    out += fmt::format("<p class=\"verdict{}\">{}</p>\n", page.accepted ? "" : " failed", io::xml_text(page.verdict));
  }
  out += "<h2>Figures</h2>\n<pre tabindex=\"0\">" + io::xml_text(page.text) + "</pre>\n";
  for (std::size_t i = 0; i < page.figures.size(); ++i) {
    const Figure& figure = page.figures[i];
    out += fmt::format("<h2>{}</h2>\n<figure>{}<figcaption>{}</figcaption></figure>\n", io::xml_text(figure.title),
                       inlined(figure, i), io::xml_text(figure.caption));
  }
  for (const std::string& note : page.notes) out += fmt::format("<p>{}</p>\n", io::xml_text(note));
  return out + "</main>\n</body>\n</html>\n";
}

}  // namespace inslab::cli
