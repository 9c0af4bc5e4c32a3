// SPDX-License-Identifier: MIT
// write-guide HELP FOLDER: the user's guide of every language, HELP/LANGUAGE/*.md, as HTML with its pictures:
// FOLDER/LANGUAGE/*.html, an index in each, FOLDER/pictures.
#include <QDir>
#include <QFile>
#include <QGuiApplication>
#include <QLocale>
#include <QRegularExpression>
#include <QTextDocument>
#include <cstdio>
#include <stdexcept>

namespace {

const char* const style =
    "body{max-width:46rem;margin:2rem auto;padding:0 1rem;font:1rem/1.6 Inter,'Noto "
    "Sans',system-ui,sans-serif;"
    "color:#241f1b;background:#f7f3ee}h1,h2{line-height:1.25}img{max-width:100%;height:auto;border:1px solid "
    "#d8cec4;border-radius:6px}a{color:#9a4617}nav{margin-bottom:2rem;font-size:.9rem}"
    "@media(prefers-color-scheme:dark){body{background:#131110;color:#dcd2c6}a{color:#e29163}}";

struct Page {
  QString id, title, text;
};

QString read(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) throw std::runtime_error("cannot read " + path.toStdString());
  return QString::fromUtf8(file.readAll());
}

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

void writeLanguage(const QDir& from, const QDir& to, const QString& language) {
  to.mkpath(".");
  QList<Page> pages;
  for (const QString& file : from.entryList({"*.md"}, QDir::Files, QDir::Name)) {
    QString text = read(from.filePath(file));
    pages.append({QString(file).remove(".md"), text.section('\n', 0, 0).remove('#').trimmed(), text});
  }
  QString index;
  for (const Page& page : pages) {
    index += QString("<li><a href=\"%1.html\">%2</a></li>\n").arg(page.id, page.title.toHtmlEscaped());
    write(
        to.filePath(page.id + ".html"),
        pageOf(language, page.title, "<nav><a href=\"index.html\">Relucent</a></nav>\n" + bodyOf(page.text)));
  }
  write(to.filePath("index.html"), pageOf(language, QLocale(language).nativeLanguageName(),
                                          "<h1>Relucent</h1>\n<ul>\n" + index + "</ul>"));
}

}  // namespace

int main(int argc, char** argv) {
  // Without a font the text has no looks; it needs none.
  QGuiApplication application(argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: write-guide HELP FOLDER\n");
    return 2;
  }
  QDir from(QString::fromLocal8Bit(argv[1])), to(QString::fromLocal8Bit(argv[2]));
  try {
    for (const QString& name : from.entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name))
      if (name != "pictures") writeLanguage(from.filePath(name), to.filePath(name), name);
    to.mkpath("pictures");
    for (const QString& name : QDir(from.filePath("pictures")).entryList({"*.png"}, QDir::Files))
      if (!QFile::copy(from.filePath("pictures/" + name), to.filePath("pictures/" + name)))
        throw std::runtime_error("cannot copy " + name.toStdString());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write-guide: %s\n", error.what());
    return 1;
  }
  return 0;
}
