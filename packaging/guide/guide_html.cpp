// SPDX-License-Identifier: MIT
#include "guide/guide_html.h"

#include <QDir>
#include <QFile>
#include <QLocale>
#include <QRegularExpression>
#include <QTextDocument>
#include <stdexcept>

#include "app/guide.h"

namespace relucent::gui {
namespace {

const char* const style =
    "body{max-width:46rem;margin:2rem auto;padding:0 1rem;font:1rem/1.6 Inter,'Noto "
    "Sans',system-ui,sans-serif;"
    "color:#241f1b;background:#f7f3ee}h1,h2{line-height:1.25}img{max-width:100%;height:auto;border:1px solid "
    "#d8cec4;border-radius:6px}a{color:#9a4617}nav{margin-bottom:2rem;font-size:.9rem}"
    "@media(prefers-color-scheme:dark){body{background:#131110;color:#dcd2c6}a{color:#e29163}}";

void write(const QString& path, const QString& text) {
  QFile file(path);
  QByteArray bytes = text.toUtf8();
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
    throw std::runtime_error("cannot write " + path.toStdString());
}

/// What Qt makes of Markdown, without the looks that it gives every paragraph.
QString bodyOf(const QString& markdown) {
  QTextDocument document;
  document.setMarkdown(markdown);
  QString html = document.toHtml();
  html = html.mid(html.indexOf('>', html.indexOf("<body")) + 1);
  html.truncate(html.lastIndexOf("</body>"));
  static const QRegularExpression strong(R"(<span style="[^"]*font-weight:[67]00;[^"]*">([^<]*)</span>)");
  static const QRegularExpression emphasis(R"(<span style="[^"]*font-style:italic;[^"]*">([^<]*)</span>)");
  static const QRegularExpression code(R"(<span style="[^"]*monospace[^"]*">([^<]*)</span>)");
  static const QRegularExpression looks(R"x( (?:style|dir|align)="[^"]*")x");
  static const QRegularExpression spans("</?span>");
  html.replace(strong, "<strong>\\1</strong>")
      .replace(emphasis, "<em>\\1</em>")
      .replace(code, "<code>\\1</code>");
  static const QRegularExpression heading(R"((<h[1-6][^>]*>)<strong>(.*)</strong>(</h[1-6]>))");
  html.remove(looks).remove(spans).replace(heading, "\\1\\2\\3");
  static const QRegularExpression link(R"x(href="([0-9a-z-]+)\.md")x");
  return html.replace(link, R"x(href="\1.html")x").trimmed();
}

QString pageOf(const QString& language, const QString& title, const QString& body) {
  QString direction = QLocale(language).textDirection() == Qt::RightToLeft ? "rtl" : "ltr";
  return QString(
             "<!DOCTYPE html>\n<html lang=\"%1\" dir=\"%2\"><head><meta charset=\"utf-8\"><meta "
             "name=\"viewport\" "
             "content=\"width=device-width, "
             "initial-scale=1\"><title>%3</title><style>%4</style></head><body>\n"
             "%5\n</body></html>\n")
      .arg(QString(language).replace('_', '-'), direction, "Relucent: " + title.toHtmlEscaped(), style, body);
}

void writeLanguage(const QList<HelpPage>& pages, const QDir& to, const QString& language) {
  to.mkpath(".");
  QString index;
  for (const HelpPage& page : pages) {
    index += QString("<li><a href=\"%1.html\">%2</a></li>\n").arg(page.id, page.title.toHtmlEscaped());
    write(to.filePath(page.id + ".html"),
          pageOf(page.language, page.title,
                 "<nav><a href=\"index.html\">Relucent</a></nav>\n" + bodyOf(page.text)));
  }
  write(to.filePath("index.html"), pageOf(language, QLocale(language).nativeLanguageName(),
                                          "<h1>Relucent</h1>\n<ul>\n" + index + "</ul>"));
}

}  // namespace

void writeGuide(const QString& help, const QString& folder) {
  QStringList languages = guideLanguages(help);
  if (languages.isEmpty()) throw std::runtime_error("no guide in " + help.toStdString());
  QDir to(folder), pictures(help + "/pictures");
  for (const QString& language : languages)
    writeLanguage(guidePages(help, language), to.filePath(language), language);
  to.mkpath("pictures");
  for (const QString& name : pictures.entryList({"*.png"}, QDir::Files))
    if (!QFile::copy(pictures.filePath(name), to.filePath("pictures/" + name)))
      throw std::runtime_error("cannot copy " + name.toStdString());
}

}  // namespace relucent::gui
