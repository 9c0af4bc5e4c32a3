// SPDX-License-Identifier: MIT
// Readers of strangers' bytes, each with thousands of inputs that are sound but for a few places.
//   RELUCENT_FUZZ_EXECUTIONS  of each target, instead of its own number
//   RELUCENT_FUZZ_SEED        of the inputs
//   RELUCENT_FUZZ_KEEP        a folder for what is found; it also holds each target's last input, the one
//                             that a crash came of
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <QtTest>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "fuzz/mutation.h"
#include "relucent/base/fingerprint.h"
#include "relucent/transport/npy.h"

using namespace relucent;
using namespace relucent::fuzz;
namespace fs = std::filesystem;

namespace {

/// A file that holds the last input whatever becomes of this program: what is mapped needs no farewell.
class LastInput {
 public:
  explicit LastInput(const fs::path& path) : path_(path) {
    if (path.empty()) return;
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0 || ::ftruncate(file, room) != 0) qFatal("cannot write %s", path.c_str());
    void* memory = ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (memory != MAP_FAILED) memory_ = static_cast<char*>(memory);
  }
  /// Of a program that lives: nothing was wrong.
  ~LastInput() {
    if (memory_ == nullptr) return;
    ::munmap(memory_, room);
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  LastInput(const LastInput&) = delete;
  LastInput& operator=(const LastInput&) = delete;

  /// The length in its first eight bytes.
  void is(std::string_view input) {
    if (memory_ == nullptr) return;
    const std::uint64_t length = std::min(input.size(), longestInput);
    std::memcpy(memory_, &length, sizeof length);
    std::memcpy(memory_ + sizeof length, input.data(), length);
  }

 private:
  static constexpr std::size_t room = longestInput + 64;
  fs::path path_;
  char* memory_ = nullptr;
};

fs::path keptFolder() {
  const char* folder = std::getenv("RELUCENT_FUZZ_KEEP");
  if (folder != nullptr) fs::create_directories(folder);
  return folder != nullptr ? folder : "";
}

QByteArray shortened(const std::string& input) {
  QByteArray bytes = QByteArray::fromStdString(input.substr(0, 400));
  return bytes.toPercentEncoding(" {}[]\":,=/<>()'!?;#&+@$*");
}

/// As the targets of arrays take the members of an archive.
std::string arrayOf(const std::string& name, const transport::NpyHeader& header, std::size_t bytes) {
  const std::string content = transport::npyText(header) + std::string(bytes, '\0');
  return name + ".npy\n" + std::to_string(content.size()) + '\n' + content;
}

/// One of the target's seeds with an array of the same name in place of its own, or beside all others.
std::string withArray(const std::string& target, std::size_t seed, const std::string& array);

std::string nested(std::size_t deep) {
  return std::string(deep, '[') + std::string(deep, ']');
}

const FuzzTarget& targetNamed(const std::string& name) {
  for (const FuzzTarget& target : allTargets())
    if (name == target.name) return target;
  qFatal("there is no target %s", name.c_str());
}

std::string withArray(const std::string& target, std::size_t seed, const std::string& array) {
  std::string members = targetNamed(target).seeds().at(seed);
  const std::string name = array.substr(0, array.find('\n') + 1);
  const std::size_t begin = members.find(name), length = begin + name.size();
  if (begin == std::string::npos) return members + array;
  const std::size_t end = members.find('\n', length) + 1 + std::stoul(members.substr(length));
  return members.replace(begin, end - begin, array);
}

/// An OpenEXR file, one of whose two windows is said to end there.
std::string withExrWindow(const std::string& name, std::int32_t right, std::int32_t bottom,
                          std::size_t seed = 0) {
  std::string file = targetNamed("exr").seeds().at(seed);
  const std::size_t at = file.find(name + '\0' + "box2i") + name.size() + 1 + 6 + 4;
  std::memcpy(&file[at + 8], &right, sizeof right);
  std::memcpy(&file[at + 12], &bottom, sizeof bottom);
  return file;
}

/// What stands before the value of an attribute of an OpenEXR file.
std::string exrAttribute(const std::string& name, const std::string& type, std::size_t length) {
  std::string attribute = name + '\0' + type + '\0';
  for (int i = 0; i < 4; ++i) attribute += static_cast<char>(length >> (8 * i) & 0xffU);
  return attribute;
}

/// One with attributes at its beginning.
std::string withExrAttributes(const std::string& attributes) {
  constexpr std::size_t prelude = 8;  // magic number and version
  return targetNamed("exr").seeds().front().insert(prelude, attributes);
}

/// A photograph that is said to be so large, most of which libjpeg makes up.
std::string withJpegSize(int width, int height) {
  std::string file;
  for (const std::string& seed : targetNamed("picture").seeds())
    if (file.empty() && seed.starts_with("\xff\xd8")) file = seed;
  const std::size_t at = file.find("\xff\xc0") + 5;  // start of the frame, its length, bits
  for (std::size_t i = 0; i < 2; ++i) {
    file.at(at + i) = static_cast<char>(height >> (8 - 8 * i) & 0xff);
    file.at(at + 2 + i) = static_cast<char>(width >> (8 - 8 * i) & 0xff);
  }
  return file;
}

/// A sound one of the target with something else instead of its first `what`.
std::string withInstead(const std::string& target, std::size_t seed, const std::string& what,
                        const std::string& instead) {
  std::string input = targetNamed(target).seeds().at(seed);
  const std::size_t at = input.find(what);
  if (at == std::string::npos) qFatal("no %s in a seed of %s", what.c_str(), target.c_str());
  return input.replace(at, what.size(), instead);
}

}  // namespace

class TestFuzz : public QObject {
  Q_OBJECT
 private slots:
  /// Law: seeds are read without a finding, and are what the readers take for sound, so that what is changed
  /// in them is what is tried.
  void readersEndInOneSentence_data() {
    QTest::addColumn<QString>("name");
    for (const FuzzTarget& target : allTargets()) QTest::newRow(target.name) << QString(target.name);
  }
  void readersEndInOneSentence() {
    QFETCH(QString, name);
    const FuzzTarget& target = targetNamed(name.toStdString());
    bool isGiven = false;
    const int wanted = qEnvironmentVariableIntValue("RELUCENT_FUZZ_EXECUTIONS", &isGiven);
    const int executions = isGiven ? wanted : target.executions;
    const auto seed = static_cast<std::uint64_t>(qEnvironmentVariableIntValue("RELUCENT_FUZZ_SEED"));
    const std::uint64_t key = Fingerprint().add(std::string_view(target.name)).low();
    const fs::path kept = keptFolder();
    std::string fileName = name.toStdString();
    std::ranges::replace(fileName, ' ', '-');
    LastInput last(kept.empty() ? kept : kept / (fileName + ".last"));

    const Mutator mutator(target);
    QVERIFY(!mutator.seeds().empty());
    std::map<std::string, std::string> findings;  // the first input of each
    const auto tryOut = [&](const std::string& input) {
      last.is(input);
      if (std::string finding = findingOf(target, bytesOf(input)); !finding.empty())
        findings.try_emplace(std::move(finding), input);
    };
    for (const std::string& sound : mutator.seeds()) tryOut(sound);
    for (int i = 0; i < executions; ++i) {
      Random random{20071028, seed, key, static_cast<std::uint64_t>(i)};
      tryOut(mutator.input(random));
    }
    int number = 0;
    for (const auto& [finding, input] : findings) {
      qWarning("%s, of %s", finding.c_str(), shortened(input).constData());
      if (!kept.empty())
        std::ofstream(kept / (fileName + "." + std::to_string(number++)), std::ios::binary) << input;
    }
    QVERIFY2(findings.empty(), qPrintable(QString("%1 findings").arg(findings.size())));
  }

  /// What a former version did not end in one sentence.
  void whatWasFoundStaysMended_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QByteArray>("input");
    const auto row = [](const char* what, const char* target, const std::string& input) {
      QTest::newRow(what) << QString(target) << QByteArray::fromStdString(input);
    };
    constexpr std::size_t deep = 60'000;
    row("a manifest that nests without end", "manifest",
        R"({"format":"relucent calibration","version":1,"results":)" + nested(deep) + "}");
    row("a shot that does", "shot",
        R"({"format":"relucent shot","version":2,"checksum":"","a":)" + nested(deep) + "}\n");
    row("a shot of more bits than a number has", "shot",
        R"({"format":"relucent shot","version":1,"stage":"a","number":1,"fingerprint":"f",)"
        R"("exposures_asked":[0.1],"checksum":"","frames":[[{"width":1,"height":1,"channels":3,)"
        R"("bits":-1,"seconds":0.1,"samples":"codes8"}]]})"
        "\nabc");
    row("a single text of many bytes", "transport arrays",
        withArray("transport arrays", 0, arrayOf("format", {"|S999999999999", {}}, 3)));
    row("colours of a great many kinds", "blocks",
        withArray("blocks", 2, arrayOf("mixing", {"<f4", {7, std::uint64_t{1} << 36, 3, 3}}, 64)));
    row("a picture of a few bytes and many pixels", "exr", withExrWindow("dataWindow", 40'000'000, 6));
    row("a line of many pixels", "exr", withExrWindow("dataWindow", 8'000'000, 1, 3));
    row("a tile of many", "exr",
        withInstead("exr", 8, std::string("\x04\0\0\0\x04\0\0\0", 8),
                    std::string("\0\x20\0\0\0\x20\0\0", 8)));
    row("a photograph of a few bytes and many pixels", "picture", withJpegSize(9000, 6000));
    row("a manifest whose settings are a text", "manifest",
        withInstead("manifest", 0, R"("settings":)", R"("settings":"a","other":)"));
    row("a picture within a huge frame", "exr", withExrWindow("displayWindow", 18000, 18000));
    const std::string owner = exrAttribute("owner", "string", 1'800'000'000);
    row("a picture whose owner's name is longer than the file", "exr", withExrAttributes(owner));
    row("the same within a number that is longer than numbers are", "exr",
        withExrAttributes(exrAttribute("a", "float", 4 + owner.size()) + std::string(4, '\0') + owner));
    row("a night's number of negative digits", "nights",
        withInstead("nights", 1, R"("decimals":0)", R"("decimals":-1)"));
  }
  void whatWasFoundStaysMended() {
    QFETCH(QString, name);
    QFETCH(QByteArray, input);
    QCOMPARE(QString::fromStdString(findingOf(targetNamed(name.toStdString()), bytesOf(input.toStdString()))),
             QString());
  }
};

QTEST_GUILESS_MAIN(TestFuzz)
#include "test_fuzz.moc"
