// SPDX-License-Identifier: MIT
#include "relucent/pipeline/standard_images.h"

#include <QtTest>
#include <algorithm>
#include <set>

#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::pipeline;

namespace {

constexpr Size size{160, 120};

const NamedImage& named(const std::vector<NamedImage>& images, const std::string& name) {
  return *std::find_if(images.begin(), images.end(),
                       [&](const NamedImage& image) { return image.name == name; });
}

/// Luminance of all pixels, the dimmest first.
std::vector<float> sortedLuminance(const image::Image& linear) {
  image::Image luminance = image::luminance(linear);
  std::sort(luminance.data().begin(), luminance.data().end());
  return luminance.data();
}
float quantile(const std::vector<float>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

class TestStandardImages : public QObject {
  Q_OBJECT
 private slots:
  void areNamedAndWithinRange_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("as they are") << 480 << 360;
    QTest::newRow("wide") << 160 << 90;
    QTest::newRow("smallest") << 8 << 8;
  }
  void areNamedAndWithinRange() {
    QFETCH(int, width);
    QFETCH(int, height);
    std::set<std::string> names;
    for (const NamedImage& image : judgedImages({width, height})) {
      names.insert(image.name);
      QCOMPARE(image.linear.size(), (Size{width, height}));
      const auto [least, most] = std::minmax_element(image.linear.data().begin(), image.linear.data().end());
      QVERIFY2(*least >= 0.0f && *most <= 1.0f, image.name.c_str());
      QVERIFY2(*most > *least, image.name.c_str());
    }
    QCOMPARE(names.size(), std::size_t{6});
  }

  void theFirstAreTheStandardOnes() {
    const std::vector<NamedImage> few = standardImages({64, 48}), all = judgedImages({64, 48});
    for (std::size_t i = 0; i < few.size(); ++i) {
      QCOMPARE(all[i].name, few[i].name);
      QCOMPARE(all[i].linear.data(), few[i].linear.data());
    }
  }

  void theNightIsDarkButForItsLamps() {
    const std::vector<NamedImage> images = judgedImages(size);
    const std::vector<float> night = sortedLuminance(named(images, "dark").linear);
    QVERIFY2(quantile(night, 0.9) < 0.012f, qPrintable(QString::number(quantile(night, 0.9))));
    QVERIFY(night.back() > 0.5f);
  }

  void linesAreDarkOnPaper() {
    const std::vector<NamedImage> images = judgedImages(size);
    const std::vector<float> drawn = sortedLuminance(named(images, "line-art").linear);
    QVERIFY(quantile(drawn, 0.5) > 0.85f);
    QVERIFY2(quantile(drawn, 0.05) < 0.4f, qPrintable(QString::number(quantile(drawn, 0.05))));
  }

  void theFilmLiesBetweenBars() {
    const image::Image film = named(judgedImages(size), "film").linear;
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c)
        QVERIFY(film.at(x, 2, c) == 0.0f && film.at(x, film.height() - 3, c) == 0.0f);
    QVERIFY(quantile(sortedLuminance(film), 0.98) > 0.2f);
  }
};

QTEST_APPLESS_MAIN(TestStandardImages)
#include "test_standard_images.moc"
