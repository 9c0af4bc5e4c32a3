// SPDX-License-Identifier: MIT
#pragma once

#include <QFile>
#include <QList>
#include <QMap>
#include <QRegularExpression>
#include <QStringList>
#include <QXmlStreamReader>

namespace relucent::gui {

/// One sentence of a file of Qt Linguist.
struct TranslatedSentence {
  QString context, source, comment;
  bool numerus = false;
  bool finished = true;
  QStringList forms;  // one; several where it depends on a number

  QString key() const { return context + '\n' + source + '\n' + comment; }
};

/// Those that the sources still have.
inline QList<TranslatedSentence> sentencesOf(const QString& path) {
  QFile file(path);
  QList<TranslatedSentence> sentences;
  if (!file.open(QIODevice::ReadOnly)) return sentences;
  QXmlStreamReader xml(&file);
  QString context;
  TranslatedSentence sentence;
  bool obsolete = false;
  while (!xml.atEnd()) {
    auto token = xml.readNext();
    if (token == QXmlStreamReader::EndElement && xml.name() == u"message" && !obsolete)
      sentences.append(sentence);
    if (token != QXmlStreamReader::StartElement) continue;
    QString name = xml.name().toString();
    if (name == "name") {
      context = xml.readElementText();
    } else if (name == "message") {
      sentence = {context, {}, {}, xml.attributes().value("numerus") == u"yes", true, {}};
      obsolete = false;
    } else if (name == "source") {
      sentence.source = xml.readElementText();
    } else if (name == "comment") {
      sentence.comment = xml.readElementText();
    } else if (name == "numerusform") {
      sentence.forms << xml.readElementText();
    } else if (name == "translation") {
      QString type = xml.attributes().value("type").toString();
      sentence.finished = type != "unfinished";
      obsolete = type == "vanished" || type == "obsolete";
      if (!sentence.numerus) sentence.forms << xml.readElementText();
    }
  }
  return sentences;
}

/// A sentence of core may have its gaps in another order: {1} {0} for {} {}, each of them once and all
/// of them so.
inline QString withoutOrder(QString text) {
  if (text.contains("{}")) return text;
  for (int gap = 0; text.count(QString("{%1}").arg(gap)) == 1; ++gap)
    text.replace(QString("{%1}").arg(gap), "{}");
  return text;
}

/// Whether it is core's: its context is a message's id, "disk.cannot-open".
inline bool isMessage(const TranslatedSentence& sentence) {
  static const QRegularExpression id("^[a-z0-9]+(?:-[a-z0-9]+)*(?:\\.[a-z0-9]+(?:-[a-z0-9]+)*)+$");
  return id.match(sentence.context).hasMatch();
}

/// How often each %1, {}, file pattern and keyboard accelerator stands in a text. What counts, `%n` and a gap
/// of a message, counts apart: a form for one or two may say it in a word.
inline QMap<QString, int> marksOf(const QString& text) {
  static const QRegularExpression mark(R"(%L?[0-9]+|\{[a-z0-9]*\}|\*\.[a-z0-9]+|&&|&(?=\S))");
  QMap<QString, int> marks;
  for (auto match = mark.globalMatch(text); match.hasNext();) {
    QString found = match.next().captured();
    if (found != "&&") ++marks[found];
  }
  return marks;
}

/// Of a form for a number that may leave a gap out: whether one stands there twice.
inline bool hasGapsTwice(const QString& form) {
  const QMap<QString, int> marks = marksOf(form);
  for (auto mark = marks.cbegin(); mark != marks.cend(); ++mark)
    if (mark.key() != "{}" && mark.value() > 1) return true;
  return false;
}

/// What is wrong with a translated sentence; empty: nothing.
inline QStringList faultsOf(const TranslatedSentence& sentence) {
  QStringList faults;
  auto fault = [&](const QString& what) {
    faults << what + ": " + sentence.context + ", " + sentence.source;
  };
  if (!sentence.finished) fault("unfinished");
  if (sentence.forms.isEmpty()) fault("without translation");
  for (const QString& form : sentence.forms) {
    if (form.trimmed().isEmpty())
      fault("empty");
    else if (!isMessage(sentence) || !sentence.numerus || form == sentence.forms.last()
                 ? marksOf(withoutOrder(form)) != marksOf(sentence.source)
                 : hasGapsTwice(form))
      fault("a placeholder or accelerator is lost or too many in \"" + form + "\"");
  }
  // The last form is the one for many.
  if (sentence.numerus && !isMessage(sentence) && !sentence.forms.isEmpty() &&
      !sentence.forms.last().contains("%n"))
    fault("%n is lost in \"" + sentence.forms.last() + "\"");
  return faults;
}

/// And what is wrong with a whole language, given the sentences of the sources.
inline QStringList faultsOf(const QList<TranslatedSentence>& language,
                            const QList<TranslatedSentence>& sources) {
  QMap<QString, TranslatedSentence> known;
  for (const TranslatedSentence& sentence : language) known.insert(sentence.key(), sentence);
  QStringList faults;
  for (const TranslatedSentence& sentence : sources) {
    auto translated = known.find(sentence.key());
    if (translated == known.end())
      faults << "missing: " + sentence.context + ", " + sentence.source;
    else
      faults << faultsOf(*translated);
  }
  return faults;
}

}  // namespace relucent::gui
