// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QLocale>
#include <QString>
#include <QStringList>
#include <QTranslator>
#include <memory>
#include <vector>

namespace relucent {

/// The language that the program speaks: its own sentences, Qt's, how numbers are written (by the default
/// QLocale, with the digits 0 to 9 in every language), and from which side one reads. What is made after
/// choose() speaks it; what was made before has to be made again.
class Language {
 public:
  /// `folder`: of relucent_LANGUAGE.qm.
  explicit Language(const QString& code, QString folder = ":/translations");
  ~Language();
  Language(const Language&) = delete;
  Language& operator=(const Language&) = delete;

  /// "de", "zh_CN": what there is a translation for.
  QStringList available() const;
  /// Empty: the computer's, as far as it is available, else English. Of a language without translation the
  /// sentences are English and the rest stays the language's.
  void choose(const QString& code);
  /// Of the sentences: "de"; "en" where nothing else fits.
  const QString& spoken() const { return spoken_; }

 private:
  void load(const QString& name, const QStringList& folders, const QLocale& locale);
  void unload();
  QString folder_;
  QString spoken_ = "en";
  std::vector<std::unique_ptr<QTranslator>> translators_;
};

}  // namespace relucent
