#include "report/page.hpp"

#include <fmt/format.h>

#include "report/html.hpp"

namespace breccia::report {
namespace {

// Fonts of the system; one column that prints; colour is never the only distinction.
constexpr const char* kStyle = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: #1b1d21; }
body { font: 15px/1.5 system-ui, "DejaVu Sans", "Liberation Sans", sans-serif; }
header, main, footer { max-width: 900px; margin: 0 auto; padding: 0 20px; }
header { padding-top: 28px; }
h1 { font-size: 1.55rem; line-height: 1.25; margin: 0 0 .4rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem; padding-bottom: .25rem; border-bottom: 1px solid #c3c8cf; }
p { margin: .4rem 0 .8rem; max-width: 46rem; overflow-wrap: anywhere; }
.state { display: inline-block; padding: .05rem .55rem; border: 1px solid; border-radius: 3px; font-weight: 600; }
.ok { color: #0b5d33; } .bad { color: #9c1c1c; } .on { color: #7a4b00; }
.tiles { display: grid; grid-template-columns: repeat(auto-fill, minmax(165px, 1fr)); }
.tiles { gap: 1px; margin: 1rem 0; padding: 1px; }
.tiles div { box-shadow: 0 0 0 1px #d5d9df; padding: .5rem .75rem; }
.tiles dt { color: #4c535c; font-size: .82rem; }
.tiles dd { margin: 0; font-size: 1.12rem; font-variant-numeric: tabular-nums; }
.warning { border-left: 4px solid #9c1c1c; background: #fbf1f0; padding: .5rem .9rem; margin: 1rem 0; }
.warning ul { margin: .3rem 0; padding-left: 1.2rem; }
nav { font-size: .88rem; margin: .6rem 0; }
nav a { margin-right: 1rem; }
a { color: #0b4f8a; }
figure { margin: 1rem 0; }
figure svg, figure img { display: block; width: 100%; height: auto; }
figure img { border: 1px solid #e1e4e8; }
figcaption { font-size: .86rem; color: #4c535c; margin-top: .3rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(330px, 1fr)); gap: 0 18px; }
.tables { display: flex; flex-wrap: wrap; gap: 0 48px; align-items: flex-start; }
.scroll { overflow-x: auto; max-width: 100%; }
table { border-collapse: collapse; margin: .7rem 0; font-size: .9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; white-space: nowrap; font-weight: 600; padding-bottom: .25rem; }
th, td { padding: .18rem .9rem .18rem 0; text-align: left; vertical-align: top; border-bottom: 1px solid #e6e9ed; }
thead th { border-bottom: 1px solid #8b929b; }
tbody th { font-weight: 400; }
th.n, td.n { text-align: right; white-space: nowrap; }
td code { font-size: .82rem; overflow-wrap: anywhere; }
svg text { font: 12px system-ui, "DejaVu Sans", "Liberation Sans", sans-serif; fill: #33383f; }
svg .grid path { stroke: #dfe3e8; stroke-width: 1; fill: none; }
svg.bar { width: 120px; height: 10px; }
pre { background: #f5f6f8; padding: .8rem; overflow-x: auto; font-size: .8rem; line-height: 1.4; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; }
summary { cursor: pointer; }
footer { color: #4c535c; font-size: .82rem; padding: 1.5rem 20px 2.5rem; }
@media print {
  @page { margin: 16mm; }
  body { font-size: 10pt; }
  header, main, footer { max-width: none; padding: 0; }
  nav { display: none; }
  figure, tr, .tiles, .warning { break-inside: avoid; }
  h2, caption { break-after: avoid; }
  .pair { grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); }
  .scroll { overflow: visible; }
  table { font-size: 8.5pt; }
  th, td { padding-right: .6rem; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
)";

const char* class_of(const std::string& state) {
  if (state == "complete") return "ok";
  return state == "running" || state == "paused" || state == "stopped" ? "on" : "bad";
}

std::string headline(const RunRecord& run, const std::string& title) {
  return fmt::format("<header>\n<h1>{}</h1>\n<p><span class=\"state {}\">{}</span> {}</p>\n</header>\n", escaped(title),
                     class_of(run.state), escaped(run.state), escaped(run.message));
}

}  // namespace

std::string page_of(const RunRecord& run, const Figures& figures, const std::string& made) {
  const std::string title = run.title.empty() ? run.folder.filename().string() : run.title;
  struct Part {
    const char *id, *title;
    std::string html;
  };
  const Part parts[]{{"pictures", "Pictures", pictures(figures)},
                     {"energy", "Energy", energies(run)},
                     {"cracks", "Broken joints", cracks(run, figures)},
                     {"fragments", "Fragments", fragments(run, figures)},
                     {"events", "Crack events", events(figures)},
                     {"contacts", "Contacts", contacts(run, figures)},
                     {"gauges", "Gauges", gauges(run)},
                     {"model", "Materials, joints and contacts", model(run)},
                     {"effort", "Phases and ranks", effort(run, figures)},
                     {"origin", "Origin", origin(run, figures, made)}};
  std::string links, sections;
  for (const Part& part : parts) {
    if (part.html.empty()) continue;
    links += fmt::format("<a href=\"#{}\">{}</a> ", part.id, part.title);
    sections += section(part.id, part.title, part.html);
  }
  // The policy permits no scripts and no requests, for any content of the page.
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
         "style-src 'unsafe-inline'\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + " – report</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + headline(run, title) +
         "<main>\n" + key_figures(run, figures) + "<nav aria-label=\"Sections\">" + links + "</nav>\n" +
         warnings(run, figures) + sections + "</main>\n<footer>Made by breccia report" +
         (made.empty() ? "" : " on " + escaped(made)) +
         ". Quantities in SI units; numbers with all their digits stand "
         "in the value of each data element.</footer>\n</body>\n</html>\n";
}

}  // namespace breccia::report
