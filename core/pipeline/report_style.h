// SPDX-License-Identifier: MIT
#pragma once

namespace relucent::pipeline {

/// The report's style sheet: the program's own colours, dark, with light paper when it is printed.
inline constexpr const char* reportStyle = R"css(
:root { --window:#131110; --card:#1F1B18; --raised:#282320; --line:#37302A; --text:#DCD2C6; --soft:#AEA294;
  --accent:#E29163; --good:#86B892; --amber:#E3B94F; --amberback:#33290F; --info:#8FB3D6; --infoback:#18232E;
  --red:#EC7F76; color-scheme:dark; }
* { box-sizing:border-box; }
body { margin:0; background:var(--window); color:var(--text);
  font:400 15px/1.5 Inter,"Noto Sans",system-ui,sans-serif; font-variant-numeric:tabular-nums; }
main, header, footer { max-width:1120px; margin:0 auto; padding:0 24px; }
header { padding-top:40px; } footer { padding:24px; color:var(--soft); font-size:13px; }
h1 { font-size:28px; font-weight:600; margin:0 0 4px; line-height:1.25; }
h2 { font-size:19px; font-weight:600; margin:0 0 4px; } h3 { font-size:15px; font-weight:600; margin:20px 0 8px; }
p { margin:0 0 12px; max-width:75ch; } .soft, figcaption, dt { color:var(--soft); }
section { background:var(--card); border:1px solid var(--line); border-radius:8px; padding:20px; margin:16px 0; }
.cards { display:grid; grid-template-columns:repeat(auto-fit,minmax(160px,1fr)); gap:12px; margin:24px 0 0; padding:0; }
.cards div { background:var(--card); border:1px solid var(--line); border-radius:8px; padding:12px 16px; }
.cards dt { font-size:13px; } .cards dd { margin:0; font-size:24px; font-weight:500; }
.pictures { display:grid; grid-template-columns:repeat(auto-fit,minmax(280px,1fr)); gap:16px; }
figure { margin:0; } figcaption { font-size:13px; margin-top:6px; } figcaption b { color:var(--text); font-weight:600; }
img { display:block; width:100%; height:auto; border-radius:4px; background:#0b0a09; image-rendering:pixelated; }
.charts { display:grid; grid-template-columns:repeat(auto-fit,minmax(360px,1fr)); gap:24px; align-items:start; }
svg.chart { width:100%; height:auto; max-width:560px; } svg.legend { width:100%; max-width:340px; height:auto; }
svg text { fill:var(--soft); font-size:12px; }
.grid { stroke:var(--line); } .axis { stroke:var(--soft); }
.c0 { stroke:#EC7F76; } .c1 { stroke:#86B892; } .c2 { stroke:#8FB3D6; } .c0,.c1,.c2 { fill:none; stroke-width:1.6; }
.bar { fill:#6E6358; } .bar.accent { fill:var(--accent); }
.before { fill:#8FB3D6; fill-opacity:.35; stroke:#8FB3D6; } .after { fill:#E29163; fill-opacity:.45; stroke:#E29163; }
.scroll { overflow-x:auto; } table { border-collapse:collapse; width:100%; font-size:14px; }
caption { text-align:left; color:var(--soft); padding-bottom:6px; }
th, td { padding:6px 12px 6px 0; text-align:right; border-bottom:1px solid var(--line); font-weight:400; white-space:nowrap; }
th:first-child, td:first-child { text-align:left; } thead th { color:var(--soft); }
tr.best td, tr.best th { color:var(--accent); font-weight:600; }
.note { border-radius:6px; padding:10px 14px; margin:8px 0; border:1px solid; list-style:none; }
.note.amber { background:var(--amberback); border-color:var(--amber); }
.note.good { border-color:var(--good); } ul { padding-left:20px; } ul.notes { padding:0; margin:0; }
details summary { cursor:pointer; font-weight:600; } details table td { font-family:monospace; white-space:normal; }
@media print { :root { --window:#fff; --card:#fff; --line:#bbb; --text:#111; --soft:#444; --amberback:#fff;
  color-scheme:light; } section { break-inside:avoid; } }
)css";

}  // namespace relucent::pipeline
