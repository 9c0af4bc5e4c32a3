// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QLocale>
#include <QString>
#include <QStringList>
#include <QTranslator>
#include <memory>
#include <vector>

namespace relucent::gui {

/// The language of the program: its own sentences, Qt's, number formats (by the default QLocale, with the
/// digits 0 to 9 in every language), and the reading direction. Widgets made after choose() use it; older
/// ones have to be made again.
class Language {
 public:
  /// `folder`: of relucent_LANGUAGE.qm.
  explicit Language(const QString& code, QString folder = ":/translations");
  ~Language();
  Language(const Language&) = delete;
  Language& operator=(const Language&) = delete;

  /// "de", "zh_CN": the available translations.
  QStringList available() const;
  /// Empty: the system's if available, else English. For a language without translation the sentences are
  /// English, number formats and direction those of the language.
  void choose(const QString& code);
  /// Language of the sentences: "de"; "en" if there is no translation.
  const QString& spoken() const { return spoken_; }

 private:
  void load(const QString& name, const QStringList& folders, const QLocale& locale);
  void unload();
  QString folder_;
  QString spoken_ = "en";
  std::vector<std::unique_ptr<QTranslator>> translators_;
};

}  // namespace relucent::gui
