// SPDX-License-Identifier: MIT
#include <QtTest>

#include "core/engine/engine_backends.h"
#include "relucent/base/error.h"
#include "relucent/engine/agreement.h"
#include "relucent/engine/fallback_backend.h"
#include "relucent/engine/view_follower.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::synthetic;

namespace {

/// Does as another back end does, until it is lost.
class FailingBackend : public EngineBackend {
 public:
  FailingBackend(const EngineVenue& engine, int frames, bool takesContent = true)
      : cpu_(engine), frames_(frames), takesContent_(takesContent) {}
  std::string_view name() const override { return "scripted"; }
  void setContent(const EngineContent& content) override {
    if (!takesContent_)
      throw Error(ErrorKind::device, Message::plain("no memory left"), Message::plain("try again"));
    cpu_.setContent(content);
  }
  void contentFollowed() override {
    takeOrFail([this] { cpu_.contentFollowed(); });
  }
  void availabilityFollowed() override {
    takeOrFail([this] { cpu_.availabilityFollowed(); });
  }
  void startFrom(std::span<const float> projector) override {
    takeOrFail([&] { cpu_.startFrom(projector); });
  }
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override {
    if (frames_-- <= 0) return false;
    return cpu_.render(frame, request, words, report);
  }
  bool sharesTextures() const override { return true; }
  bool renderToTextures(const ContentFrame&, const FrameRequest&, std::span<const std::uint32_t>,
                        FrameReport&) noexcept override {
    return frames_-- > 0;
  }

 private:
  void takeOrFail(const std::function<void()>& take) const {
    if (frames_ <= 0)
      throw Error(ErrorKind::device, Message::plain("the card is gone"), Message::plain("try again"));
    take();
  }

  CpuBackend cpu_;
  int frames_;
  bool takesContent_;
};

/// The processor's pictures, but for the red of some pixels, which is darker.
class DarkerBackend : public CpuBackend {
 public:
  DarkerBackend(const EngineVenue& engine, int codes, int every)
      : CpuBackend(engine), codes_(codes), every_(static_cast<std::size_t>(every)) {}
  std::string_view name() const override { return "darker"; }
  bool render(const ContentFrame& frame, const FrameRequest& request, std::span<std::uint32_t> words,
              FrameReport& report) noexcept override {
    if (!CpuBackend::render(frame, request, words, report)) return false;
    for (std::size_t i = 0; i < words.size(); i += every_) {
      const int red = codeOf(words[i], 0);
      words[i] -= static_cast<std::uint32_t>(std::min(red, codes_));
    }
    return true;
  }

 private:
  int codes_;
  std::size_t every_;
};

}  // namespace

class TestFallbackBackend : public QObject {
  Q_OBJECT

 private slots:
  void losesNoFrame_data() {
    QTest::addColumn<int>("goodFrames");
    QTest::addColumn<bool>("takesContent");
    QTest::newRow("the first frame") << 0 << true;
    QTest::newRow("the third frame") << 2 << true;
    QTest::newRow("never") << 100 << true;
    QTest::newRow("the content") << 100 << false;
  }
  /// All frames are what the other back end makes of them, and one sentence says that it took over.
  void losesNoFrame() {
    QFETCH(int, goodFrames);
    QFETCH(bool, takesContent);
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    Image content = makeContent(Content::natural, {37, 28}, 3);
    EngineContent placed = prepareContent(engine, content.size());
    CpuBackend alone(engine);
    alone.setContent(placed);
    std::vector<std::string> told;
    FallbackBackend backend(
        std::make_unique<FailingBackend>(engine, goodFrames, takesContent),
        [&] { return std::make_unique<CpuBackend>(engine); },
        [&](const Message& sentence) { told.push_back(english(sentence)); });
    backend.setContent(placed);
    for (int frame = 0; frame < 5; ++frame) {
      const FrameRequest request{true, frame % 3, 1.0f, 0.0f};
      std::vector<std::uint32_t> words(engine.brightest.size()), expected(words.size());
      FrameReport report;
      QVERIFY(backend.render(frameOf(content), request, words, report));
      alone.render(frameOf(content), request, expected, report);
      QVERIFY(words == expected);
    }
    const bool lost = goodFrames < 5 || !takesContent;
    QCOMPARE(told.size(), std::size_t{lost ? 1u : 0u});
    if (lost) QVERIFY(told[0].starts_with("scripted: ") && told[0].find("CPU") != std::string::npos);
    QCOMPARE(backend.name().starts_with("CPU"), lost);
  }

  /// Law: lost while content follows a viewer, or is given a start, the other one has what it follows to.
  void losesNoViewer_data() {
    QTest::addColumn<bool>("starts");
    QTest::newRow("follows") << false;
    QTest::newRow("starts") << true;
  }
  void losesNoViewer() {
    QFETCH(bool, starts);
    EngineScene made = engineSceneOf("two views");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    Image content = makeContent(Content::natural, {37, 28}, 3);
    EngineContent placed = prepareContent(engine, content.size());
    ViewFollower follower(engine, placed);
    int told = 0;
    FallbackBackend backend(
        std::make_unique<FailingBackend>(engine, 1), [&] { return std::make_unique<CpuBackend>(engine); },
        [&](const Message&) { ++told; });
    backend.setContent(placed);
    std::vector<std::uint32_t> words(engine.brightest.size()), expected(words.size());
    FrameReport report;
    QVERIFY(backend.render(frameOf(content), {}, words, report));
    follower.follow(std::vector<double>{0.25, 0.75}, placed);
    if (starts) {
      backend.startFrom(ProjectorStack(3 * words.size(), 0.5f));
    } else {
      backend.contentFollowed();
    }
    QCOMPARE(told, 1);
    FrameRequest request;
    request.fromLast = !starts;
    QVERIFY(backend.render(frameOf(content), request, words, report));
    CpuBackend alone(engine);
    alone.setContent(placed);
    QVERIFY(alone.render(frameOf(content), {}, expected, report));
    QVERIFY(words == expected);
  }

  /// Law: lost while it renders to textures, the frame is there to be rendered to memory.
  void losesNoFrameOnTheCard() {
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    Image content = makeContent(Content::natural, {37, 28}, 3);
    EngineContent placed = prepareContent(engine, content.size());
    int told = 0;
    FallbackBackend backend(
        std::make_unique<FailingBackend>(engine, 2), [&] { return std::make_unique<CpuBackend>(engine); },
        [&](const Message&) { ++told; });
    backend.setContent(placed);
    std::vector<std::uint32_t> textures(1), words(engine.brightest.size());
    FrameReport report;
    for (int frame = 0; frame < 2; ++frame) {
      QVERIFY(backend.sharesTextures());
      QVERIFY(backend.renderToTextures(frameOf(content), {}, textures, report));
    }
    QVERIFY(!backend.renderToTextures(frameOf(content), {}, textures, report));
    QCOMPARE(told, 1);
    QVERIFY(!backend.sharesTextures());
    QVERIFY(backend.render(frameOf(content), {}, words, report));
    QVERIFY(backend.name().starts_with("CPU"));
  }

  void bothLost() {
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    Image content = makeContent(Content::natural, {12, 9}, 3);
    EngineContent placed = prepareContent(engine, content.size());
    FallbackBackend backend(std::make_unique<FailingBackend>(engine, 0),
                            [&] { return std::make_unique<FailingBackend>(engine, 1); }, {});
    backend.setContent(placed);
    std::vector<std::uint32_t> words(engine.brightest.size());
    FrameReport report;
    QVERIFY(backend.render(frameOf(content), {}, words, report));
    QVERIFY(!backend.render(frameOf(content), {}, words, report));

    FallbackBackend helpless(std::make_unique<FailingBackend>(engine, 0),
                             []() -> std::unique_ptr<EngineBackend> {
                               throw Error(ErrorKind::memory, Message::plain("none"),
                                           Message::plain("buy some"));
                             },
                             {});
    helpless.setContent(placed);
    QVERIFY(!helpless.render(frameOf(content), {}, words, report));
    QVERIFY(!helpless.render(frameOf(content), {}, words, report));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, FallbackBackend(nullptr, {}, {}));
  }

  /// A graphics card that goes in the middle of a show, as far as that can be had here.
  void graphicsCardLost() {
    SKIP_WHERE_MISSING("OpenGL");
    EngineScene made = engineSceneOf("defocus");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    Image content = makeContent(Content::text, {37, 28}, 3);
    EngineContent placed = prepareContent(engine, content.size());
    auto first = std::make_unique<OpenGlBackend>(engine, std::make_unique<GlContext>(GlContext::Device::any));
    OpenGlBackend* card = first.get();
    int told = 0;
    FallbackBackend backend(
        std::move(first), [&] { return std::make_unique<CpuBackend>(engine); },
        [&](const Message&) { ++told; });
    backend.setContent(placed);
    std::vector<std::uint32_t> before(engine.brightest.size()), after(before.size());
    FrameReport report;
    QVERIFY(backend.render(frameOf(content), {}, before, report));
    QVERIFY(backend.name().starts_with("OpenGL"));
    card->loseDevice();
    QVERIFY(backend.render(frameOf(content), {}, after, report));
    QVERIFY(backend.name().starts_with("CPU"));
    QCOMPARE(told, 1);
    // Rounding to other levels where a value lies between two: see test_backends.
    QVERIFY(mostApart(before, after) <= 1);
  }

  void picturesAreProven_data() {
    QTest::addColumn<int>("codes");
    QTest::addColumn<int>("every");
    QTest::addColumn<bool>("good");
    QTest::newRow("the same") << 0 << 1 << true;
    QTest::newRow("rounded otherwise") << 2 << 1 << true;
    QTest::newRow("one in five thousand") << 100 << 5000 << true;
    QTest::newRow("one in a hundred") << 100 << 100 << false;
    QTest::newRow("all a little") << 5 << 1 << false;
    QTest::newRow("black") << 255 << 1 << false;
  }
  /// Law: what makes other pictures than the processor shows none of them, and one sentence says so.
  void picturesAreProven() {
    QFETCH(int, codes);
    QFETCH(int, every);
    QFETCH(bool, good);
    EngineScene made = engineSceneOf("several devices");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    Image content = makeContent(Content::natural, {37, 28}, 3);
    const EngineContent placed = prepareContent(engine, content.size());
    std::vector<std::string> told;
    const auto agrees = [&](EngineBackend& a, EngineBackend& b, const EngineContent& c) {
      return agree(a, b, engine, c);
    };
    const auto cpu = [&] { return std::make_unique<CpuBackend>(engine); };
    FallbackBackend backend(
        std::make_unique<DarkerBackend>(engine, codes, every), cpu,
        [&](const Message& sentence) { told.push_back(english(sentence)); }, agrees);
    for (int times = 0; times < 2; ++times) backend.setContent(placed);
    QCOMPARE(told.size(), std::size_t{good ? 0u : 1u});
    QCOMPARE(backend.name() == "darker", good);
    if (!good) QVERIFY(told[0].starts_with("darker: ") && told[0].find("driver") != std::string::npos);
    // Law: the proof leaves nothing to go on from.
    CpuBackend alone(engine);
    alone.setContent(placed);
    FrameRequest request;
    request.fromLast = true;
    std::vector<std::uint32_t> words(engine.brightest.size()), expected(words.size());
    FrameReport report;
    QVERIFY(backend.render(frameOf(content), request, words, report));
    QVERIFY(alone.render(frameOf(content), request, expected, report));
    QVERIFY(mostApart(words, expected) <= (good ? codes : 0));
  }

  void choice() {
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    QVERIFY(makeBackend(engine, BackendChoice::cpu, {})->name().starts_with("CPU"));
    // A processor that pretends to be a graphics card is no reason to leave the back end made for it.
    std::unique_ptr<EngineBackend> automatic = makeBackend(engine, BackendChoice::automatic, {});
    QVERIFY(!isSoftwareRenderer(std::string(automatic->name())));
    SKIP_WHERE_MISSING("OpenGL");
    QVERIFY(makeBackend(engine, BackendChoice::openGl, {})->name().starts_with("OpenGL"));
  }

  void softwareRenderers_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("software");
    QTest::newRow("llvmpipe") << "llvmpipe (LLVM 15.0.6, 256 bits)" << true;
    QTest::newRow("softpipe") << "softpipe" << true;
    QTest::newRow("Mesa's oldest") << "Software Rasterizer" << true;
    QTest::newRow("swrast") << "SWRast" << true;
    QTest::newRow("NVIDIA") << "NVIDIA GeForce RTX 3060/PCIe/SSE2" << false;
    QTest::newRow("AMD") << "AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49)" << false;
    QTest::newRow("Intel") << "Mesa Intel(R) UHD Graphics 630 (CFL GT2)" << false;
  }
  void softwareRenderers() {
    QFETCH(QString, name);
    QFETCH(bool, software);
    QCOMPARE(isSoftwareRenderer(name.toStdString()), software);
  }
};

QTEST_GUILESS_MAIN(TestFallbackBackend)
#include "test_fallback_backend.moc"
