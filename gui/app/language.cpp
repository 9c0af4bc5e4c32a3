// SPDX-License-Identifier: MIT
#include "app/language.h"

#include <QCoreApplication>
#include <QDir>
#include <QGuiApplication>
#include <QLibraryInfo>

namespace relucent::gui {
namespace {

/// Some numbers are written where no locale is asked, with the digits 0 to 9: so that all agree, of the
/// countries that speak the language one that writes it with these.
QLocale withLatinDigits(const QLocale& locale) {
  auto isUsual = [](const QLocale& one) { return one.zeroDigit() == "0"; };
  if (isUsual(locale)) return locale;
  QList<QLocale> same = QLocale::matchingLocales(locale.language(), locale.script(), QLocale::AnyTerritory);
  same.removeIf([&](const QLocale& one) { return !isUsual(one); });
  for (const QLocale& one : same)
    if (one.decimalPoint() == ".") return one;
  return same.isEmpty() ? QLocale(QLocale::English) : same.first();
}

/// A computer that speaks the language says how it writes times and numbers; else English is British here, as
/// its words are, with the clock of 24 hours.
QLocale localeOf(const QString& code) {
  if (code.isEmpty()) return QLocale::system();
  const QLocale wanted(code), here = QLocale::system();
  if (wanted.language() == here.language() && wanted.script() == here.script()) return here;
  if (wanted.language() == QLocale::English) return QLocale(QLocale::English, QLocale::UnitedKingdom);
  return wanted;
}

}  // namespace

Language::Language(const QString& code, QString folder) : folder_(std::move(folder)) {
  choose(code);
}

Language::~Language() {
  unload();
}

void Language::unload() {
  for (const auto& translator : translators_) QCoreApplication::removeTranslator(translator.get());
  translators_.clear();
}

QStringList Language::available() const {
  QStringList found;
  for (QString file : QDir(folder_).entryList({"relucent_*.qm"}, QDir::Files, QDir::Name))
    found << file.remove("relucent_").remove(".qm");
  return found;
}

void Language::load(const QString& name, const QStringList& folders, const QLocale& locale) {
  for (const QString& folder : folders) {
    auto translator = std::make_unique<QTranslator>();
    if (!translator->load(locale, name, "_", folder)) continue;
    QCoreApplication::installTranslator(translator.get());
    translators_.push_back(std::move(translator));
    return;
  }
}

void Language::choose(const QString& code) {
  unload();
  const QLocale locale = localeOf(code);
  load("relucent", {folder_}, locale);
  // English too has a file: its plurals.
  if (translators_.empty()) load("relucent", {folder_}, QLocale(QLocale::English));
  QString file = translators_.empty() ? QString() : translators_.back()->filePath();
  spoken_ = file.isEmpty() ? "en" : file.section("relucent_", -1).remove(".qm");
  if (spoken_ != "en") load("qtbase", {QLibraryInfo::path(QLibraryInfo::TranslationsPath)}, QLocale(spoken_));
  // "zh_CN" in a computer's "zh_SG" keeps the computer's numbers; English sentences read from the left.
  QLocale::setDefault(withLatinDigits(locale));
  QGuiApplication::setLayoutDirection(QLocale(spoken_).textDirection());
}

}  // namespace relucent::gui
