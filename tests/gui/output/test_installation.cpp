// SPDX-License-Identifier: MIT
#include "output/installation.h"

#include <QDir>
#include <QFileInfo>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QtTest>

#include "support/sentences.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

QString lineOf(const QString& text, const QString& key) {
  for (const QString& line : text.split('\n'))
    if (line.startsWith(key + '=')) return line.mid(key.size() + 1);
  return {};
}

/// What a doubled sign stands for; one that stands alone would mean something else, and is wrong.
QString undoubled(const QString& word, QChar sign) {
  QString result;
  for (int i = 0; i < word.size(); ++i) {
    if (word[i] == sign && (++i == word.size() || word[i] != sign)) return "a single " + QString(sign);
    result += word[i];
  }
  return result;
}

/// The words of ExecStart= as systemd.syntax(7) says that it reads them.
QStringList readBySystemd(const QString& line) {
  QStringList words;
  for (int i = 0; i < line.size(); ++i) {
    if (line[i] == ' ') continue;
    QString word;
    for (++i; line[i] != '"'; ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else if (line[++i] == 'x') {
        word += QChar(line.mid(i + 1, 2).toInt(nullptr, 16));
        i += 2;
      } else {
        word += line[i];
      }
    }
    word = undoubled(word, '%');
    words.append(words.isEmpty() ? word : undoubled(word, '$'));
  }
  return words;
}

/// The words of Exec= as the desktop entry specification has them read: the string value first, then quotes.
QStringList readByDesktop(QString line) {
  line.replace("\\\\", "\\");
  QStringList words;
  for (int i = 0; i < line.size(); ++i) {
    if (line[i] == ' ') continue;
    QString word;
    for (++i; line[i] != '"'; ++i) word += line[i] == '\\' ? line[++i] : line[i];
    words.append(undoubled(word, '%'));
  }
  return words;
}

}  // namespace

Q_DECLARE_METATYPE(Start)

class TestInstallation : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  QString read(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
  }

 private slots:
  void whichVenueIsInstalledIsKnown_data() {
    QTest::addColumn<Start>("start");
    QTest::newRow("service") << Start::service;
    QTest::newRow("autostart") << Start::autostart;
  }
  void whichVenueIsInstalledIsKnown() {
    QFETCH(Start, start);
    QTemporaryDir config;
    const QString venue = "/venues/Chapel \"niche\" 100 %";
    QVERIFY(!isInstalled(start, config.path(), venue));
    install(start, config.path(), "/opt/relucent", {"show", venue, "--content", "list"});
    QVERIFY(isInstalled(start, config.path()));
    QVERIFY(isInstalled(start, config.path(), venue));
    QVERIFY(!isInstalled(start, config.path(), "/venues/Chapel"));
    QVERIFY(!isInstalled(start, config.path(), venue + " 2"));
    QCOMPARE(installedValue(start, config.path(), "--content"), QString("list"));
    QCOMPARE(installedValue(start, config.path(), "--night"), QString());
  }

  void everyPathArrivesAsItIs_data() {
    QTest::addColumn<QString>("path");
    for (const char* path :
         {"/venues/dome", "/my venues/the dome", "/a\"b'c", "/back\\slash\\", "/100 % & $HOME",
          "/%h $$ ${USER}", "/`date`", "/Köln ☃", "/a;b|c>d<e&f*?[x]{y}~#!", "/=, -x", "/x\\\\\"$%"})
      QTest::newRow(path) << QString(path);
  }
  void everyPathArrivesAsItIs() {
    QFETCH(QString, path);
    QString program = path + "/relucent";
    QStringList arguments{"show", path, "--content", path + "/a b", ""};
    QStringList all = QStringList{program} + arguments;
    QCOMPARE(readBySystemd(lineOf(systemdUnit(program, arguments), "ExecStart")), all);
    QCOMPARE(readByDesktop(lineOf(autostartEntry(program, arguments), "Exec")), all);
  }

  void controlCharactersAreWrittenOrRefused() {
    QString path = "/two\nlines\tand a tab";
    QString unit = systemdUnit("/relucent", {path});
    QCOMPARE(readBySystemd(lineOf(unit, "ExecStart")), (QStringList{"/relucent", path}));
    QVERIFY(mentions(sentenceOf([&] { autostartEntry("/relucent", {path}); }, ErrorKind::input), "control"));
  }

  void theUnitIsSwitchedOnAndTakenAway() {
    QString config = folder_.filePath("config");
    QString file = install(Start::service, config, "/bin/true", {"one"});
    QCOMPARE(file, config + "/systemd/user/relucent-show.service");
    QFileInfo enabled(config + "/systemd/user/graphical-session.target.wants/relucent-show.service");
    QVERIFY(enabled.isSymLink());
    QCOMPARE(enabled.symLinkTarget(), file);
    QVERIFY(read(file).contains("Restart=on-failure") &&
            read(file).contains("WantedBy=graphical-session.target"));
    // Again, with something else.
    install(Start::service, config, "/bin/true", {"two"});
    QVERIFY(read(enabled.filePath()).contains("two") && !read(file).contains("one"));
    QCOMPARE(QDir(QFileInfo(file).path()).entryList(QDir::Files).size(), 1);  // nothing is left behind

    QCOMPARE(uninstall(Start::service, config), file);
    QVERIFY(!QFile::exists(file) && !QFileInfo(enabled.filePath()).isSymLink());
    QVERIFY(uninstall(Start::service, config).isEmpty());
  }

  void theEntryIsWrittenAndTakenAway() {
    QString config = folder_.filePath("desktop");
    QString file = install(Start::autostart, config, "/bin/true", {"one"});
    QCOMPARE(file, config + "/autostart/relucent-show.desktop");
    QVERIFY(read(file).startsWith("[Desktop Entry]\nType=Application\n"));
    QCOMPARE(uninstall(Start::autostart, config), file);
    QVERIFY(!QFile::exists(file) && uninstall(Start::autostart, config).isEmpty());
  }

  void whatCannotBeWrittenIsNamed() {
    QFile file(folder_.filePath("file"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    for (Start start : {Start::service, Start::autostart})
      QVERIFY(mentions(sentenceOf([&] { install(start, file.fileName(), "/bin/true", {}); }, ErrorKind::disk),
                       file.fileName().toStdString()));
  }

  /// systemd's own opinion, where it is installed.
  void systemdUnderstandsTheUnit() {
    QString tool = QStandardPaths::findExecutable("systemd-analyze");
    if (tool.isEmpty()) QSKIP("systemd-analyze is not installed");
    QString file = install(Start::service, folder_.filePath("analyzed"), "/bin/true", {"a \"b\" $c %d \\"});
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("XDG_RUNTIME_DIR", folder_.path());
    process.setProcessEnvironment(environment);
    process.start(tool, {"--user", "verify", file});
    QVERIFY(process.waitForFinished());
    QString said = process.readAllStandardError();
    if (said.contains("Failed to initialize")) QSKIP("systemd does not run here");
    QVERIFY2(process.exitCode() == 0, qPrintable(said));
  }
};

QTEST_GUILESS_MAIN(TestInstallation)
#include "test_installation.moc"
