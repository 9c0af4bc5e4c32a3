// SPDX-License-Identifier: MIT
// Patterns written, photographed by a made-up venue, read back: files and folders of an import.
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "relucent/base/error.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/devices/raw/raw_photograph.h"
#include "relucent/image/colour.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/import.h"
#include "relucent/pipeline/memory_needed.h"
#include "relucent/pipeline/plan.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/relight.h"
#include "relucent/pipeline/stored_settings.h"
#include "support/dng.h"
#include "support/sanitized.h"
#include "support/scripted_rig.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::importing;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::test;
namespace fs = std::filesystem;

namespace {

constexpr Size projector{40, 32};
constexpr Size camera{36, 28};

/// A folder with a plan and photographs of it.
struct Photographed {
  explicit Photographed(Size size) {
    PatternPlanSettings plan;
    plan.projector = projector;
    Progress progress;
    const fs::path root = folder.path().toStdString();
    written = exportPlan(plan, root / "plan", progress);
    SyntheticSettings synthetic;
    synthetic.projectors = {projector};
    synthetic.cameras = {size};
    ScriptedVenue venue(syntheticTransport(synthetic), {}, {});
    Rig rig = venue.rig();
    fs::create_directories(root / "photographs");
    int number = 0;
    for (const fs::path& file : written.files) {
      if (file.extension() != ".png") continue;
      rig.projectors.front()->show(readPicture(file).encoded);
      RawFrame frame = rig.cameras.front()->capture({{"plan", number}, 0, 0.03});
      writePng(root / "photographs" / fmt::format("IMG_{:04}.png", 100 + number++), frame.signal, 16);
    }
  }
  QTemporaryDir folder;
  WrittenFiles written;
};

/// Taken once for each size of the camera's.
const Photographed& photographed(Size size) {
  static std::map<std::pair<int, int>, std::unique_ptr<Photographed>> all;
  std::unique_ptr<Photographed>& one = all[{size.width, size.height}];
  if (!one) one = std::make_unique<Photographed>(size);
  return *one;
}

/// A copy of them, and what comes of it.
class Studio {
 public:
  explicit Studio(Size size = camera) {
    const Photographed& once = photographed(size);
    const fs::path from = once.folder.path().toStdString();
    fs::copy(from, root(), fs::copy_options::recursive);
    for (const fs::path& file : once.written.files)
      written.files.push_back(root() / fs::relative(file, from));
  }

  fs::path patterns() const { return root() / "plan"; }
  fs::path photographs() const { return root() / "photographs"; }
  fs::path calibration() const { return root() / "calibration"; }
  ImportPicturesSettings settings(const reduction::PixelUse& pixels) const {
    ImportPicturesSettings settings;
    settings.pixels = pixels;
    settings.patterns = patterns();
    settings.photographs = photographs();
    return settings;
  }
  ImportResult import(const reduction::PixelUse& pixels = {}) const {
    Progress progress;
    return importPictures(calibration(), settings(pixels), progress);
  }
  QString failure() const {
    try {
      import();
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  /// The photographs become raw files that are numbered from `first` on, with times three seconds apart, and
  /// a JPEG beside each that must not be looked at.
  void becomeRaw(int first) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(photographs())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    int number = first, second = 0;
    for (const fs::path& file : files) {
      Dng dng = dngOf(readPicture(file).encoded);
      dng.taken = fmt::format("2026:11:21 19:{:02}:{:02}", second / 60, second % 60);
      second += 3;
      const std::string name = fmt::format("IMG_{:04}", number);
      number = number == 9999 ? 1 : number + 1;
      std::ofstream(photographs() / (name + ".DNG"), std::ios::binary) << bytesOf(dng);
      std::ofstream(photographs() / (name + ".JPG")) << "no picture";
      fs::remove(file);
    }
  }

  WrittenFiles written;

 private:
  fs::path root() const { return folder_.path().toStdString(); }
  QTemporaryDir folder_;
};

}  // namespace

class TestImportPictures : public QObject {
  Q_OBJECT
 private slots:
  /// Bins hold four times the light of their samples: what is held out is predicted no worse.
  void photographsOfManyPixelsAreReduced() {
    Studio studio({120, 96});
    const ImportResult reduced = studio.import();
    {
      const auto folder = calibration::CalibrationFolder::open(studio.calibration(),
                                                               calibration::CalibrationFolder::Access::read);
      const std::vector<reduction::Reduction> reductions = reductionsOf(folder);
      QCOMPARE(reductions.size(), std::size_t{1});
      QVERIFY(reductions[0].bin >= 2);
      QCOMPARE(reductions[0].camera, (Size{120, 96}));
      const auto acquired = calibration::currentResultOf(folder, calibration::Stage::acquisition);
      QVERIFY(acquired.has_value());
      QCOMPARE(calibration::loadAcquisition(*acquired).transport.cameras(), Rasters(reductions[0].size()));
    }
    if (isSanitized) return;  // qualities are compared without sanitizers
    fs::remove_all(studio.calibration());
    const ImportResult whole = studio.import({reduction::PixelUse::Kind::all});
    QVERIFY2(reduced.error.transport < 1.2 * whole.error.transport,
             qPrintable(
                 QString("%1, %2 with all pixels").arg(reduced.error.transport).arg(whole.error.transport)));
  }

  /// Law: as many camera pixels as there is memory for, and a sentence where even few do not fit.
  void asManyPixelsAsFit() {
    Studio studio({72, 56});
    const auto pictures =
        static_cast<int>(photographed({72, 56}).written.files.size()) - 2;  // beside two texts
    const auto importWith = [&](std::uint64_t bytes, reduction::PixelUse pixels) {
      fs::remove_all(studio.calibration());
      Progress progress;
      const std::uint64_t plenty = std::uint64_t{1} << 40;
      return importPictures(studio.calibration(), studio.settings(pixels), {bytes, plenty}, progress);
    };
    const std::uint64_t some = memoryOfImport(projector, {30, 30}, pictures).resident;
    const ImportResult result = importWith(some, {});
    QVERIFY(result.camera == (Size{72, 56}));
    {
      const auto folder = calibration::CalibrationFolder::open(studio.calibration(),
                                                               calibration::CalibrationFolder::Access::read);
      const reduction::Reduction reduction = reductionsOf(folder).at(0);
      QVERIFY(reduction.savesMemory);
      QVERIFY(memoryOfImport(projector, reduction.size(), pictures).resident <= some);
    }
    const std::string sentence =
        sentenceOf([&] { importWith(some, {reduction::PixelUse::Kind::all}); }, ErrorKind::memory);
    QVERIFY(mentions(sentence, "automatic ones are as many as fit"));
    QVERIFY(mentions(sentenceOf([&] { importWith(100'000, {}); }, ErrorKind::memory), "fewer pictures"));
    QVERIFY(!fs::exists(studio.calibration()));
  }

  /// Whichever photograph it is: the reduction is chosen by two of them.
  void anotherSizeAmongManyPixelsIsSaid_data() {
    QTest::addColumn<int>("number");
    for (int number : {0, 1, 2, 5}) QTest::addRow("photograph %d", number) << number;
  }
  void anotherSizeAmongManyPixelsIsSaid() {
    QFETCH(int, number);
    Studio studio({120, 96});
    // The first of all, and neither the brightest nor the darkest.
    for (int other : {0, 1})
      if (number == 2) {
        fs::remove(studio.written.files[static_cast<std::size_t>(other)]);
        fs::remove(studio.photographs() / fmt::format("IMG_{:04}.png", 100 + other));
      }
    writePng(studio.photographs() / fmt::format("IMG_{:04}.png", 100 + number), Image({60, 50}, 3, 0.9f), 8);
    const QString failure = studio.failure();
    QVERIFY2(failure.contains("60x50") && failure.contains("120x96"), qPrintable(failure));
  }

  void aPlanComesBackAsACalibration() {
    Studio studio;
    QVERIFY(fs::exists(studio.patterns() / "plan.json"));
    QVERIFY(fs::exists(studio.patterns() / "instructions.txt"));
    ImportResult result = studio.import();
    QCOMPARE(result.fitted + result.heldOut, result.patterns);
    QCOMPARE(static_cast<std::size_t>(result.patterns) + 2, studio.written.files.size());
    // Held out are the finest stripes with their negatives, which a camera coarser than the projector hardly
    // sees: 0.42 against 0.61 of a one-to-one map.
    QVERIFY2(result.error.transport < 0.8 * result.error.oneToOne,
             qPrintable(QString("%1 of %2").arg(result.error.transport).arg(result.error.oneToOne)));

    Progress progress;
    RelightSettings relighting;
    relighting.image = studio.written.files.front();
    relighting.out = studio.calibration() / "relit.exr";
    QCOMPARE(relight(studio.calibration(), relighting, progress).files.size(), std::size_t{1});
    CompensateSettings compensation;
    compensation.image = studio.written.files.at(1);
    compensation.method = Method::windows;
    compensation.out = studio.calibration() / "compensated";
    QVERIFY(compensate(studio.calibration(), compensation, progress).psnrPredicted > 10.0);
    QVERIFY_EXCEPTION_THROWN(evaluate(studio.calibration(), {}, {}, progress), Error);
    QVERIFY(studio.failure().contains("already"));
  }

  /// Photographs as a camera develops them, with the curve of sRGB and in 8 bits, are as good as linear ones
  /// but for the file's losses; and the result says that the curve was assumed.
  void jpegPhotographsAreMadeLinear() {
    Studio studio;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(studio.photographs())) files.push_back(entry.path());
    for (fs::path file : files) {
      Image encoded = srgbEncoded(readPicture(file).encoded);
      cv::Mat pixels(encoded.height(), encoded.width(), CV_8UC3);
      for (int y = 0; y < encoded.height(); ++y)
        for (int x = 0; x < encoded.width(); ++x)
          for (int c = 0; c < 3; ++c)
            pixels.at<cv::Vec3b>(y, x)[2 - c] = cv::saturate_cast<std::uint8_t>(255.0f * encoded.at(x, y, c));
      fs::remove(file);
      QVERIFY(cv::imwrite(file.replace_extension(".jpg").string(), pixels, {cv::IMWRITE_JPEG_QUALITY, 98}));
    }
    ImportResult result = studio.import();
    QVERIFY2(result.error.transport < 0.8 * result.error.oneToOne,
             qPrintable(QString("%1 of %2").arg(result.error.transport).arg(result.error.oneToOne)));
    auto isJpeg = [](const Message& finding) { return english(finding).find("JPEG") != std::string::npos; };
    QVERIFY(std::any_of(result.findings.begin(), result.findings.end(), isJpeg));
  }

  /// What an intervalometer leaves behind: raw files every three seconds with a JPEG beside each, the camera
  /// counting over 9999.
  void rawPhotographsAreReadInTheOrderInWhichTheyWereTaken() {
    if (!hasRawPhotographs()) QSKIP("this build lacks LibRaw");
    Studio studio;
    studio.becomeRaw(9970);
    ImportResult result = studio.import();
    QCOMPARE(result.camera, camera);
    QCOMPARE(static_cast<std::size_t>(result.patterns) + 2, studio.written.files.size());
    // As with 16-bit pictures: 14 bits are still far below what the model leaves unexplained.
    QVERIFY2(result.error.transport < 0.8 * result.error.oneToOne,
             qPrintable(QString("%1 of %2").arg(result.error.transport).arg(result.error.oneToOne)));
    auto isOrder = [](const Message& finding) {
      return english(finding).find("from IMG_9970.DNG") != std::string::npos;
    };
    QVERIFY(std::any_of(result.findings.begin(), result.findings.end(), isOrder));
    auto isJpeg = [](const Message& finding) { return english(finding).find("JPEG") != std::string::npos; };
    QVERIFY(std::none_of(result.findings.begin(), result.findings.end(), isJpeg));
  }

  void aRawPhotographTooFewOrTooManyIsNamed() {
    if (!hasRawPhotographs()) QSKIP("this build lacks LibRaw");
    Studio studio;
    studio.becomeRaw(100);
    fs::rename(studio.photographs() / "IMG_0110.DNG", studio.photographs() / "IMG_0110.DNG.txt");
    fs::remove(studio.photographs() / "IMG_0110.JPG");
    const QString missing = studio.failure();
    QVERIFY2(missing.contains("1 is missing, judging by the camera's clock after IMG_0109.DNG"),
             qPrintable(missing));
    fs::rename(studio.photographs() / "IMG_0110.DNG.txt", studio.photographs() / "IMG_0110.DNG");
    fs::copy(studio.photographs() / "IMG_0120.DNG", studio.photographs() / "IMG_0120b.DNG");
    const QString extra = studio.failure();
    QVERIFY2(extra.contains("1 is too many, judging by the camera's clock these: IMG_0120b.DNG"),
             qPrintable(extra));
    QVERIFY(!fs::exists(studio.calibration()));
  }

  void aDamagedRawPhotographIsNamed() {
    if (!hasRawPhotographs()) QSKIP("this build lacks LibRaw");
    Studio studio;
    studio.becomeRaw(100);
    fs::resize_file(studio.photographs() / "IMG_0110.DNG", 3000);
    const QString failure = studio.failure();
    QVERIFY2(failure.contains("IMG_0110.DNG: the raw file cannot be read"), qPrintable(failure));
  }

  void saysWhatIsWrong_data() {
    QTest::addColumn<QString>("fault");
    QTest::addColumn<QString>("sentence");
    QTest::addRow("a photograph too few") << "missing"
                                          << "patterns but";
    QTest::addRow("another size") << "size"
                                  << "has 20x10 pixels";
    QTest::addRow("NaN") << "nan"
                         << "NaN";
    QTest::addRow("not a picture") << "text"
                                   << "IMG_0105.png";
    QTest::addRow("no photographs") << "empty"
                                    << "holds no pictures";
    QTest::addRow("no folder") << "gone"
                               << "cannot be read";
  }
  void saysWhatIsWrong() {
    QFETCH(QString, fault);
    QFETCH(QString, sentence);
    Studio studio;
    fs::path victim = studio.photographs() / "IMG_0105.png";
    if (fault == "missing") fs::remove(victim);
    if (fault == "size") writePng(victim, Image({20, 10}, 3, 0.5f), 8);
    if (fault == "text") std::ofstream(victim) << "not a picture";
    if (fault == "nan") {
      fs::remove(victim);
      writeExr(studio.photographs() / "IMG_0105.exr", Image(camera, 3, std::nanf("")), ExrType::floatType);
    }
    if (fault == "empty" || fault == "gone") fs::remove_all(studio.photographs());
    if (fault == "empty") fs::create_directories(studio.photographs());
    QString failure = studio.failure();
    QVERIFY2(failure.contains(sentence), qPrintable(failure));
    QVERIFY(!fs::exists(studio.calibration()));
  }

  void plansHaveTheProjectorsSize() {
    Progress progress;
    QTemporaryDir folder;
    PatternPlanSettings settings;
    settings.projector = {33, 9};
    fs::path out = folder.filePath("plan").toStdString();
    WrittenFiles written = exportPlan(settings, out, progress);
    QCOMPARE(readPicture(written.files.front()).encoded.size(), settings.projector);
    QVERIFY_EXCEPTION_THROWN(exportPlan(settings, out, progress), Error);
    settings.projector = {4, 4};
    QVERIFY_EXCEPTION_THROWN(exportPlan(settings, folder.filePath("other").toStdString(), progress), Error);
  }
};

QTEST_GUILESS_MAIN(TestImportPictures)
#include "test_import_pictures.moc"
