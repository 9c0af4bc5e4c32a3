// SPDX-License-Identifier: MIT
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/random.h"
#include "relucent/calibration/earlier_shots.h"
#include "relucent/calibration/shot_journal.h"
using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::image;
using namespace relucent::rig;
namespace fs = std::filesystem;

namespace {

constexpr const char* fingerprint = "0123456789abcdef0123456789abcdef";

/// A frame as a camera of so many bits gives it; 0: any floats. The corners of the range are in it.
RawFrame frameOf(Size size, int bits, std::uint64_t seed) {
  Random random{seed, static_cast<std::uint64_t>(bits)};
  RawFrame frame{Image(size, 3), bits, 0.1 + random.uniform()};
  for (float& sample : frame.signal.data()) {
    double full = std::pow(2.0, bits) - 1.0;
    sample = bits == 0 ? static_cast<float>(random.normal())
                       : static_cast<float>(
                             static_cast<double>(random.below(static_cast<std::uint64_t>(full) + 1)) / full);
  }
  frame.signal.data().front() = 0.0f;
  frame.signal.data().back() = 1.0f;
  return frame;
}

Shot shotOf(int number, Size size = {24, 16}, int bits = 12) {
  auto seed = static_cast<std::uint64_t>(number);
  Shot shot{{"acquisition", number}, fingerprint, {}, {0.25, 1.0 / 3.0}};
  for (std::uint64_t exposure = 0; exposure < 2; ++exposure)
    shot.frames.push_back(
        {frameOf(size, bits, 10 * seed + exposure), frameOf({9, 7}, 0, 10 * seed + exposure)});
  return shot;
}

/// Equal to the last bit: Image's own comparison takes 0 for -0.
bool identical(const Shot& a, const Shot& b) {
  auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  auto sameFrame = [&](const RawFrame& x, const RawFrame& y) {
    return x.bits == y.bits && x.seconds == y.seconds && x.signal.size() == y.signal.size() &&
           x.signal.channels() == y.signal.channels() &&
           std::equal(x.signal.data().begin(), x.signal.data().end(), y.signal.data().begin(),
                      y.signal.data().end(), [&](float p, float q) { return bits(p) == bits(q); });
  };
  auto sameExposure = [&](const std::vector<RawFrame>& x, const std::vector<RawFrame>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), sameFrame);
  };
  return a.id == b.id && a.fingerprint == b.fingerprint && a.exposuresAsked == b.exposuresAsked &&
         std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(), b.frames.end(), sameExposure);
}

std::set<fs::path> filesIn(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path());
  return files;
}

fs::path onlyFileIn(const fs::path& folder) {
  return fs::directory_iterator(folder)->path();
}

}  // namespace

class TestShotJournal : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir temporary_;
  fs::path folder_;

 private slots:
  void init() {
    temporary_ = QTemporaryDir();
    folder_ = fs::path(temporary_.path().toStdString()) / "shots";
  }

  /// Law: what earlier sessions took is from shot to shot, of those that are found, whatever lies between two
  /// sessions, however often they are found, and without this session's own.
  void earlierSessionsAreTimedByTheirShots() {
    using namespace std::chrono_literals;
    ShotJournal journal(folder_);
    const fs::file_time_type first = fs::file_time_type::clock::now() - 3h;
    const std::vector<std::chrono::seconds> kept{0s, 10s, 20s, 3620s, 3640s, 3641s};
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const std::set<fs::path> before = filesIn(folder_);
      journal.keep(shotOf(static_cast<int>(i)));
      for (const fs::path& file : filesIn(folder_))
        if (!before.contains(file)) fs::last_write_time(file, first + kept[i]);
    }
    EarlierShots earlier(journal);
    QCOMPARE(earlier.seconds(), 0.0);
    for (int round = 0; round < 2; ++round)
      for (int number = 0; number < 5; ++number) QVERIFY(earlier.find(shotOf(number).id, fingerprint));
    QCOMPARE(earlier.seconds(), 40.0);
    earlier.keep(shotOf(6));
    QVERIFY(earlier.find(shotOf(6).id, fingerprint) && !earlier.find({"acquisition", 7}, fingerprint));
    QCOMPARE(earlier.seconds(), 40.0);
    // Of what was kept until a result was stored that says what it took, the times say nothing more.
    earlier.remember(fs::file_time_type::max(), 17.0);
    QCOMPARE(earlier.seconds(), 17.0);
  }

  void findsWhatWasKept_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("bytesPerSample");
    QTest::newRow("float") << 0 << 4;
    QTest::newRow("1 bit") << 1 << 1;
    QTest::newRow("8 bits") << 8 << 1;
    QTest::newRow("9 bits") << 9 << 2;
    QTest::newRow("10 bits") << 10 << 2;
    QTest::newRow("12 bits") << 12 << 2;
    QTest::newRow("14 bits") << 14 << 2;
    QTest::newRow("16 bits") << 16 << 2;
  }
  void findsWhatWasKept() {
    QFETCH(int, bits);
    QFETCH(int, bytesPerSample);
    Size size{640, 48};
    Shot shot{{"linearization", 3}, fingerprint, {{frameOf(size, bits, 1)}}, {0.5}};
    ShotJournal journal(folder_);
    journal.keep(shot);
    QCOMPARE(journal.bytesOfLast(), fs::file_size(onlyFileIn(folder_)));
    std::optional<Shot> found = ShotJournal(folder_).find(shot.id, fingerprint);
    QVERIFY(found);
    QVERIFY(identical(*found, shot));
    // The header takes less than a kilobyte.
    auto samples = 3 * size.count() * static_cast<std::size_t>(bytesPerSample);
    QCOMPARE(plainBytes(shot), samples);
    QVERIFY(fs::file_size(onlyFileIn(folder_)) < samples + 1024);
  }

  void findsEveryBitOfOddFloats() {
    float odd[] = {-0.0f, 0.0f, 1e-45f, 3.4e38f, -1.5f, std::numeric_limits<float>::infinity()};
    // Also where the camera claims codes that the samples are not.
    for (int bits : {0, 8, 12}) {
      Shot shot{{"a", bits}, fingerprint, {{RawFrame{Image({2, 1}, 3, {odd, odd + 6}), bits, 1.0}}}, {1.0}};
      ShotJournal journal(folder_);
      journal.keep(shot);
      QVERIFY(identical(journal.find(shot.id, fingerprint).value(), shot));
    }
  }

  /// A smooth picture with the noise that photons have at 15000 electrons takes half of its codes.
  void photographsAreCompressed_data() {
    QTest::addColumn<int>("bits");
    for (int bits : {8, 12, 14}) QTest::addRow("%d bits", bits) << bits;
  }
  void photographsAreCompressed() {
    QFETCH(int, bits);
    Random random{5};
    RawFrame frame{Image({640, 480}, 3), bits, 0.5};
    const double full = std::pow(2.0, bits) - 1.0;
    for (std::size_t i = 0; i < frame.signal.data().size(); ++i) {
      const double light = 0.2 + 0.15 * std::sin(static_cast<double>(i) / 40000.0);
      const double noisy = light + random.normal() * std::sqrt(light / 15000.0);
      frame.signal.data()[i] = static_cast<float>(std::round(noisy * full) / full);
    }
    Shot shot{{"acquisition", 1}, fingerprint, {{frame}}, {0.5}};
    ShotJournal(folder_).keep(shot);
    QVERIFY(identical(ShotJournal(folder_).find(shot.id, fingerprint).value(), shot));
    const double plain = (bits > 8 ? 2.0 : 1.0) * static_cast<double>(frame.signal.data().size());
    const auto stored = static_cast<double>(fs::file_size(onlyFileIn(folder_)));
    QVERIFY2(stored < (bits == 14 ? 0.65 : 0.5) * plain, std::to_string(stored / plain).c_str());
  }

  /// As programs before compression wrote them.
  void plainFilesOfEarlierProgramsAreRead() {
    std::string header =
        R"({"exposures_asked":[0.5],"fingerprint":"0123456789abcdef0123456789abcdef","format":"relucent shot",)"
        R"("frames":[[{"bits":12,"channels":3,"height":1,"samples":"codes16","seconds":0.5,"width":2}]],)"
        R"("number":4,"stage":"acquisition","version":1})";
    const std::uint16_t codes[] = {0, 1, 4095, 7, 300, 2048};
    const std::string samples(reinterpret_cast<const char*>(codes), sizeof codes);
    const std::string checksum = Fingerprint().add(header).add(samples).hex();
    header.insert(1, "\"checksum\":\"" + checksum + "\",");
    ShotJournal journal(folder_);
    std::ofstream(folder_ / "acquisition-000004-01234567.shot", std::ios::binary) << header << "\n"
                                                                                  << samples;
    std::optional<Shot> found = journal.find({"acquisition", 4}, fingerprint);
    QVERIFY(found);
    const std::vector<float>& signal = found->frames[0][0].signal.data();
    for (std::size_t i = 0; i < 6; ++i)
      QCOMPARE(signal[i], static_cast<float>(static_cast<double>(codes[i]) / 4095.0));
  }

  void severalExposuresAndCamerasKeepTheirPlaces() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(7));
    QVERIFY(identical(journal.find({"acquisition", 7}, fingerprint).value(), shotOf(7)));
    QVERIFY(!identical(journal.find({"acquisition", 7}, fingerprint).value(), shotOf(8)));
  }

  void findsNothingElse() {
    ShotJournal journal(folder_);
    QVERIFY(!journal.find({"acquisition", 1}, fingerprint));
    journal.keep(shotOf(1));
    QVERIFY(!journal.find({"acquisition", 2}, fingerprint));
    QVERIFY(!journal.find({"linearization", 1}, fingerprint));
    QVERIFY(!journal.find({"acquisition", 1}, "ffffffffffffffffffffffffffffffff"));
    // The same first digits, which the file's name shows, are not enough.
    QVERIFY(!journal.find({"acquisition", 1}, "0123456789abcdefffffffffffffffff"));
  }

  /// Law: what a file holds counts, not its name.
  void anotherShotUnderTheNameIsNotFound() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(1));
    const fs::path first = onlyFileIn(folder_);
    fs::copy_file(first, folder_ / "acquisition-000002-01234567.shot");
    fs::copy_file(first, folder_ / "linearization-000001-01234567.shot");
    QVERIFY(!journal.find({"acquisition", 2}, fingerprint));
    QVERIFY(!journal.find({"linearization", 1}, fingerprint));
    QVERIFY(journal.find({"acquisition", 1}, fingerprint));
  }

  void onlyPlainNamesBecomeFiles_data() {
    QTest::addColumn<std::string>("stage");
    QTest::addColumn<std::string>("print");
    QTest::addColumn<bool>("isPlain");
    const std::string plain = fingerprint;
    QTest::newRow("plain") << std::string("acquisition") << plain << true;
    QTest::newRow("with - and _") << std::string("acquisition-1_a") << plain << true;
    QTest::newRow("empty") << std::string() << plain << false;
    QTest::newRow("out of the folder") << std::string("../acquisition") << plain << false;
    QTest::newRow("point at the end") << std::string("acquisition.") << plain << false;
    QTest::newRow("point at the beginning") << std::string(".acquisition") << plain << false;
    QTest::newRow("space") << std::string("acquisition 1") << plain << false;
    QTest::newRow("no fingerprint") << std::string("acquisition") << std::string() << false;
    QTest::newRow("fingerprint out of the folder") << std::string("acquisition") << "/../" + plain << false;
  }
  void onlyPlainNamesBecomeFiles() {
    QFETCH(std::string, stage);
    QFETCH(std::string, print);
    QFETCH(bool, isPlain);
    ShotJournal journal(folder_);
    Shot shot = shotOf(1, {3, 2});
    shot.id.stage = stage;
    shot.fingerprint = print;
    if (isPlain) {
      journal.keep(shot);
      QVERIFY(journal.find(shot.id, print));
    } else {
      QVERIFY_THROWS_EXCEPTION(std::logic_error, journal.keep(shot));
      QVERIFY_THROWS_EXCEPTION(std::logic_error, journal.find(shot.id, print));
    }
    QCOMPARE(filesIn(folder_).size(), isPlain ? 1u : 0u);
  }

  void shotsOfOtherSettingsStay() {
    ShotJournal journal(folder_);
    Shot first = shotOf(1);
    Shot second = shotOf(2);
    second.id = first.id;
    second.fingerprint = "fedcba98765432100123456789abcdef";
    journal.keep(first);
    journal.keep(second);
    QVERIFY(identical(journal.find(first.id, first.fingerprint).value(), first));
    QVERIFY(identical(journal.find(first.id, second.fingerprint).value(), second));
  }

  void aForgottenShotIsGoneAndNoOther() {
    ShotJournal journal(folder_);
    for (int number : {1, 2, 3}) journal.keep(shotOf(number));
    journal.forget(shotOf(2).id, shotOf(2).fingerprint);
    journal.forget(shotOf(9).id, shotOf(9).fingerprint);  // never kept: nothing to do
    QVERIFY(!journal.find(shotOf(2).id, shotOf(2).fingerprint));
    QVERIFY(identical(journal.find(shotOf(1).id, shotOf(1).fingerprint).value(), shotOf(1)));
    QVERIFY(identical(journal.find(shotOf(3).id, shotOf(3).fingerprint).value(), shotOf(3)));
  }

  void aShotKeptAgainReplacesADamagedOne() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(1));
    fs::resize_file(onlyFileIn(folder_), 100);
    QVERIFY(!journal.find({"acquisition", 1}, fingerprint));
    journal.keep(shotOf(1));
    QVERIFY(journal.find({"acquisition", 1}, fingerprint));
  }

  void noTruncationIsTakenForAShot() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(1, {3, 2}));
    fs::path file = onlyFileIn(folder_);
    std::string whole = readFile(file);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      std::ofstream(file, std::ios::binary) << whole.substr(0, length);
      QVERIFY2(!journal.find({"acquisition", 1}, fingerprint), std::to_string(length).c_str());
    }
    std::ofstream(file, std::ios::binary) << whole << "x";
    QVERIFY(!journal.find({"acquisition", 1}, fingerprint));
  }

  void noChangedByteIsTakenForAShot() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(1, {3, 2}));
    fs::path file = onlyFileIn(folder_);
    std::string whole = readFile(file);
    for (std::size_t place = 0; place < whole.size(); ++place) {
      std::string changed = whole;
      changed[place] = static_cast<char>(changed[place] ^ 1);
      std::ofstream(file, std::ios::binary) << changed;
      QVERIFY2(!journal.find({"acquisition", 1}, fingerprint), std::to_string(place).c_str());
    }
  }

  void foreignThingsAreIgnored() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(1));
    fs::path file = onlyFileIn(folder_);
    for (std::string foreign :
         {"", "{}\n", "\n\n", "null\n", "{\"format\":\"relucent shot\",\"version\":1,\"checksum\":3}\n"}) {
      std::ofstream(file, std::ios::binary) << foreign;
      QVERIFY(!journal.find({"acquisition", 1}, fingerprint));
    }
    fs::remove(file);
    createFolder(file);
    QVERIFY(!journal.find({"acquisition", 1}, fingerprint));
  }

  void openingClearsLeftoversAndNothingElse() {
    createFolder(folder_);
    std::ofstream(folder_ / ".acquisition-000001-01234567.part99.shot") << "half";
    const std::set<fs::path> others{folder_ / "notes.txt", folder_ / ".hidden.shot", folder_ / ".a.part1.txt",
                                    folder_ / "a.part1.shot"};
    for (const fs::path& other : others) std::ofstream(other) << "mine";
    ShotJournal journal(folder_);
    QVERIFY(filesIn(folder_) == others);
  }

  void aFullDiskIsAnErrorAndDamagesNothing() {
    ShotJournal journal(folder_);
    journal.keep(shotOf(1));
    pid_t child = ::fork();
    if (child == 0) {
      // The system refuses to write beyond this size, as it does on a full disk.
      ::signal(SIGXFSZ, SIG_IGN);
      rlimit limit{1000, 1000};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      int seen = 0;
      for (int number : {1, 2}) {
        try {
          journal.keep(shotOf(number));
        } catch (const Error& error) {
          if (error.kind() == ErrorKind::disk) ++seen;
        }
      }
      ::_exit(seen == 2 ? 0 : 1);
    }
    int status = 0;
    QCOMPARE(::waitpid(child, &status, 0), child);
    QVERIFY(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    QVERIFY(identical(journal.find({"acquisition", 1}, fingerprint).value(), shotOf(1)));
    QVERIFY(!journal.find({"acquisition", 2}, fingerprint));
    QCOMPARE(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
  }

  /// Law: whatever instant the program is killed at, every shot that keep() returned from is there bit for
  /// bit, at most one more is, and everything else is a leftover that the next start clears away.
  void killedAtAnyInstant() {
    Random random{2026};
    // Made once, so that the child spends its time in keep().
    Shot shot = shotOf(0, {320, 240});
    auto numbered = [&shot](int number) -> const Shot& {
      shot.id.number = number;
      shot.frames[0][0].signal.at(1, 1, 1) = static_cast<float>(number / 4095.0);
      return shot;
    };
    int next = 0;
    for (int round = 0; round < 8; ++round) {
      int done[2];
      QCOMPARE(::pipe(done), 0);
      pid_t child = ::fork();
      if (child == 0) {
        ::close(done[0]);
        ShotJournal journal(folder_);
        for (int number = next;; ++number) {
          journal.keep(numbered(number));
          char byte = 1;
          if (::write(done[1], &byte, 1) != 1) ::_exit(1);
        }
      }
      ::close(done[1]);
      char byte = 0;
      int announced = 0;
      for (std::uint64_t shots = 1 + random.below(4); shots > 0; --shots)
        announced += static_cast<int>(::read(done[0], &byte, 1));
      // Some instant within the shots that follow: a shot takes a few milliseconds.
      auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(random.below(10000));
      while (std::chrono::steady_clock::now() < until) {
      }
      ::kill(child, SIGKILL);
      int status = 0;
      QCOMPARE(::waitpid(child, &status, 0), child);
      QVERIFY(WIFSIGNALED(status));
      while (::read(done[0], &byte, 1) == 1) ++announced;
      ::close(done[0]);

      ShotJournal journal(folder_);
      for (int number = 0; number < next + announced; ++number) {
        std::optional<Shot> found = journal.find({"acquisition", number}, fingerprint);
        QVERIFY2(found && identical(*found, numbered(number)), std::to_string(number).c_str());
      }
      next += announced;
      if (journal.find({"acquisition", next}, fingerprint)) ++next;
      QCOMPARE(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), next);
    }
  }

  /// Not a test of speed: says what it is on this machine (ctest -V, or run by hand).
  void costOfOneExposure() {
    Shot shot{{"acquisition", 1}, fingerprint, {{frameOf({640, 480}, 12, 1)}}, {0.5}};
    ShotJournal journal(folder_);
    QBENCHMARK {
      journal.keep(shot);
    }
    QVERIFY(fs::file_size(onlyFileIn(folder_)) < 2'500'000);
  }
};

QTEST_APPLESS_MAIN(TestShotJournal)
#include "test_shot_journal.moc"
