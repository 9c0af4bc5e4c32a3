// SPDX-License-Identifier: MIT
// A film is heard: played into a sound server of the test's own, whose output is recorded.
#include <QElapsedTimer>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <cstring>

#include "avi_film.h"
#include "content/video.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace std::chrono_literals;

namespace {

constexpr int rate = 8000;  // samples a second

}  // namespace

class TestSound : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  QProcess server_, recorder_;
  QByteArray heard_;

  /// The newest quarter of a second; empty before there is so much.
  std::vector<double> newest() {
    heard_ += recorder_.readAllStandardOutput();
    constexpr qsizetype bytes = rate / 4 * 2;
    if (heard_.size() < bytes) return {};
    heard_ = heard_.right(bytes + heard_.size() % 2);
    std::vector<double> samples;
    for (qsizetype i = 0; i + 1 < heard_.size(); i += 2) {
      qint16 sample = 0;
      std::memcpy(&sample, heard_.constData() + i, 2);
      samples.push_back(sample);
    }
    return samples;
  }
  double loudness() {
    double sum = 0.0;
    std::vector<double> samples = newest();
    for (double sample : samples) sum += sample * sample;
    return samples.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(samples.size()));
  }
  bool isSilent() {
    std::vector<double> samples = newest();
    return !samples.empty() && loudness() < 10.0;
  }

 private slots:
  void initTestCase() {
    for (const char* tool : {"pulseaudio", "parec"})
      if (QStandardPaths::findExecutable(tool).isEmpty())
        QSKIP("pulseaudio is not installed; packaging/test installs it");
    QString socket = folder_.filePath("socket");
    // A home of its own: nothing of the user's sound is touched.
    for (const char* name : {"HOME", "XDG_RUNTIME_DIR", "XDG_CONFIG_HOME"})
      qputenv(name, folder_.path().toUtf8());
    qputenv("PULSE_SERVER", "unix:" + socket.toUtf8());
    server_.setStandardErrorFile(QProcess::nullDevice());
    server_.start("pulseaudio", {"-n", "--daemonize=no", "--exit-idle-time=-1", "--use-pid-file=no",
                                 "--disable-shm=yes", "-L", "module-null-sink sink_name=venue", "-L",
                                 "module-native-protocol-unix auth-anonymous=1 socket=" + socket});
    QTRY_VERIFY(QFile::exists(socket));
    recorder_.start("parec", {"--device=venue.monitor", "--raw", "--format=s16le", "--channels=1",
                              QString("--rate=%1").arg(rate), "--latency-msec=20"});
    QTRY_VERIFY(isSilent());
  }
  void cleanupTestCase() {
    for (QProcess* process : {&recorder_, &server_}) {
      process->terminate();
      process->waitForFinished(5000);
    }
  }

  /// Sound runs with the time that the film is asked for, and only with it.
  void aFilmIsHeardWhileItsTimeRuns() {
    AviFilm made;
    made.frames = 250;
    made.samples = [](int, int, int) { return std::array{126, 128, 128}; };
    QVERIFY(write(folder_.filePath("film.avi"), aviOf(made)));
    Video video(folder_.filePath("film.avi"), {{made.width, made.height}, Fit::fill});
    QElapsedTimer real;
    real.start();
    auto running = [&] {
      return std::chrono::duration_cast<ContentTime>(std::chrono::nanoseconds(real.nsecsElapsed()));
    };
    auto heard = [&](ContentTime time) {
      video.at(time);
      return loudness() > 200.0;  // the film's tone has 800
    };
    QTRY_VERIFY(heard(running()));

    // It is the film's tone of 500 Hz: two changes of sign a period.
    int changes = 0;
    std::vector<double> samples;
    auto whole = [&] {
      video.at(running());
      samples = newest();
      changes = 0;
      for (std::size_t i = 1; i < samples.size(); ++i)
        changes += (samples[i] > 0.0) != (samples[i - 1] > 0.0);
      return std::abs(changes - 250) <= 12;
    };
    QTRY_VERIFY(whole());

    ContentTime frozen = running();
    auto silent = [&] {
      video.at(frozen);
      return isSilent();
    };
    QTRY_VERIFY(silent());
    real.start();
    QTRY_VERIFY(heard(frozen + running()));
    QTRY_VERIFY(isSilent());  // nobody asks any more
  }
};

QTEST_GUILESS_MAIN(TestSound)
#include "test_sound.moc"
