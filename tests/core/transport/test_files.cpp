// SPDX-License-Identifier: MIT
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <functional>

#include "random_blocks.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/transport/files.h"

using namespace relucent;
using namespace relucent::transport;
namespace fs = std::filesystem;

namespace {

const QString python = "/usr/bin/python3";

/// Runs a Python script in `folder`; its standard output, or the error.
bool runPython(const fs::path& folder, const QString& script, QString& output) {
  QProcess process;
  process.setWorkingDirectory(QString::fromStdString(folder.string()));
  process.start(python, {"-I", "-c", script});  // whatever lies in the folder stays out of it
  if (!process.waitForStarted() || !process.waitForFinished(60000)) return false;
  output = QString::fromUtf8(process.readAllStandardOutput() + process.readAllStandardError()).trimmed();
  return process.exitCode() == 0;
}

/// Changes the file's arrays, `a` by name.
bool changeArrays(const fs::path& folder, const QString& change, QString& output) {
  return runPython(folder,
                   "import numpy as n; a = {k: n.array(v) for k, v in n.load('matrix.npz').items()}; " +
                       change + "; n.savez('matrix.npz', **a)",
                   output);
}

bool scipyIsThere() {
  QString output;
  static const bool there = runPython(fs::temp_directory_path(), "import scipy.sparse", output);
  return there;
}

/// Rows on very different scales, an empty row, an empty column.
BlockSparse someBlocks() {
  RandomBlocks blocks = randomBlocks(31, 23, 0.3, 3);
  Stack factor(3 * 31);
  for (std::size_t row = 0; row < 31; ++row)
    for (std::size_t c = 0; c < 3; ++c)
      factor[3 * row + c] = std::pow(10.0f, static_cast<float>(row % 7) - 3.0f);
  return blocks.sparse.withRowsScaled(factor).filtered(
      [&](std::size_t row, std::size_t entry) { return row != 5 && blocks.sparse.column(entry) != 4; });
}

TransportMatrix someTransport() {
  Rasters cameras(std::vector<Size>{{5, 3}, {2, 2}}), projectors(std::vector<Size>{{13, 7}, {1, 5}});
  return {cameras, projectors, randomBlocks(cameras.count(), NodeLayout(projectors).count(), 0.2, 9).sparse};
}

TransportMatrix someSharedTransport() {
  const TransportMatrix own = someTransport();
  return {own.cameras(), own.projectors(),
          randomSharedBlocks(own.ownLeaves().rows(), own.ownLeaves().columns(), 0.2, 9).sparse};
}

}  // namespace

class TestFiles : public QObject {
  Q_OBJECT

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void savedAndLoadedIsIdentical_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("blocks") << 0;
    QTest::newRow("no blocks") << 1;
    QTest::newRow("no rows") << 2;
    QTest::newRow("shared colours") << 3;
  }
  void savedAndLoadedIsIdentical() {
    QFETCH(int, kind);
    BlockSparse blocks = kind == 0   ? someBlocks()
                         : kind == 1 ? BlockSparseBuilder(7, {1.0f, 0.0f}).build()
                         : kind == 2 ? BlockSparseBuilder(7, {}).build()
                                     : randomSharedBlocks(20, 30, 0.3, 1).sparse;
    saveBlocks(path(), blocks);
    // As numbers for every reader: read back, every block has colours of its own.
    const BlockSparse loaded = loadBlocks(path());
    if (kind == 3)
      QVERIFY((denseOf(loaded) - denseOf(blocks)).cwiseAbs().maxCoeff() <= 0.51 / 32767.0);
    else
      QVERIFY(loaded == blocks);
    // Equal matrices make equal files.
    std::string first = readFile(path());
    saveBlocks(path(), blocks);
    QVERIFY(readFile(path()) == first);
  }

  void transportKeepsItsDevices_data() {
    QTest::addColumn<StoredValues>("values");
    QTest::addColumn<bool>("shared");
    QTest::addColumn<double>("bytesOfBlock");
    QTest::newRow("floats") << StoredValues::floats << false << 40.0;
    QTest::newRow("codes") << StoredValues::codes << false << 22.0;
    QTest::newRow("shared colours") << StoredValues::codes << true << 10.0;
  }
  void transportKeepsItsDevices() {
    QFETCH(StoredValues, values);
    QFETCH(bool, shared);
    QFETCH(double, bytesOfBlock);
    TransportMatrix transport = shared ? someSharedTransport() : someTransport();
    saveTransport(path(), transport, values);
    // Beside the blocks there are a scale or colours, and an index of each row, and headers.
    const auto others =
        (shared ? 8.0 + 3.0 * 36.0 : 8.0) * static_cast<double>(transport.ownLeaves().rows()) + 3000.0;
    QVERIFY(static_cast<double>(fs::file_size(path())) <
            bytesOfBlock * static_cast<double>(transport.ownLeaves().blocks()) + others);
    TransportMatrix loaded = loadTransport(path());
    QVERIFY(loaded.cameras() == transport.cameras());
    QVERIFY(loaded.projectors() == transport.projectors());
    QVERIFY(loaded.ownLeaves() == transport.ownLeaves());
    QVERIFY(loadBlocks(path()) == transport.ownLeaves());
  }

  void scipyOpensCodes() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    TransportMatrix transport = someTransport();
    saveTransport(path(), transport, StoredValues::codes);
    QString output;
    bool ran = runPython(folder(),
                         "import scipy.sparse as s, numpy as n; m = s.load_npz('matrix.npz'); "
                         "scale = n.repeat(n.load('matrix.npz')['scale'], 3); "
                         "t = s.diags(scale.astype(float)) @ m.astype(float); "
                         "print(m.dtype, '%.17g' % t.sum())",
                         output);
    QVERIFY2(ran, qPrintable(output));
    const QStringList words = output.split(' ');
    QCOMPARE(words[0], QString("int16"));
    const double expected = denseOf(transport.ownLeaves()).sum();
    QVERIFY(std::abs(words[1].toDouble() - expected) < 1e-9 * std::abs(expected));
  }

  void scipyOpensIt() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    BlockSparse blocks = someBlocks();
    saveBlocks(path(), blocks);
    ProjectorStack x(randomStack(blocks.columns(), 5));
    Eigen::VectorXd expected = denseOf(blocks) * vectorOf(x);
    QString values;
    for (float value : x) values += QString::number(static_cast<double>(value), 'g', 17) + ",";
    QString output;
    bool ran = runPython(folder(),
                         "import scipy.sparse as s, numpy as n; m = s.load_npz('matrix.npz'); "
                         "print(type(m).__name__, m.blocksize, m.shape, m.dtype, m.has_sorted_indices); "
                         "y = m.astype(float) @ n.array([" +
                             values + "]); print(*['%.17g' % v for v in y])",
                         output);
    QVERIFY2(ran, qPrintable(output));
    QStringList lines = output.split('\n');
    QCOMPARE(lines[0], QString("bsr_matrix (3, 3) (93, 69) float32 True"));
    QStringList numbers = lines[1].split(' ');
    QCOMPARE(numbers.size(), expected.size());
    // Both products are in double precision: what differs is the order of sums.
    for (Eigen::Index i = 0; i < expected.size(); ++i)
      QVERIFY(std::abs(numbers[i].toDouble() - expected[i]) <= 1e-12 * (1.0 + std::abs(expected[i])));
  }

  /// A researcher's own matrix: no scale, compressed, 64-bit indices, double values.
  void whatScipyWritesIsRead_data() {
    QTest::addColumn<QString>("save");
    QTest::newRow("compressed") << "s.save_npz('matrix.npz', m)";
    QTest::newRow("uncompressed") << "s.save_npz('matrix.npz', m, compressed=False)";
    QTest::newRow("64-bit indices") << "n.savez('matrix.npz', data=m.data, indices=m.indices.astype('i8'), "
                                       "indptr=m.indptr.astype('i8'), shape=m.shape, format=b'bsr')";
    QTest::newRow("doubles") << "s.save_npz('matrix.npz', m.astype(float))";
  }
  void whatScipyWritesIsRead() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    QFETCH(QString, save);
    QString output;
    QVERIFY2(runPython(folder(),
                       "import scipy.sparse as s, numpy as n; "
                       "m = s.bsr_matrix((n.arange(27, dtype='f4').reshape(3,3,3), [0,4,1], [0,2,2,3]), "
                       "shape=(9,15)); " +
                           save,
                       output),
             qPrintable(output));
    BlockSparse blocks = loadBlocks(path());
    QCOMPARE(blocks.rows(), std::size_t{3});
    QCOMPARE(blocks.columns(), std::size_t{5});
    QCOMPARE(blocks.blocks(), std::size_t{3});
    QCOMPARE(blocks.column(1), 4u);
    for (std::size_t entry = 0; entry < 3; ++entry)
      for (int i = 0; i < 9; ++i)
        QVERIFY(std::abs(blocks.block(entry < 2 ? 0 : 2, entry).data()[i] - static_cast<float>(9 * entry) -
                         static_cast<float>(i)) <= 0.501f * 26.0f / 32767.0f);
  }

  void brokenFilesAreRefused_data() {
    QTest::addColumn<QString>("change");  // Python on a dictionary `a` of arrays
    QTest::addColumn<QString>("word");
    QTest::newRow("csr") << "a['format'] = b'csr'"
                         << "BSR";
    QTest::newRow("no data") << "del a['data']"
                             << "'data'";
    QTest::newRow("no indptr") << "del a['indptr']"
                               << "'indptr'";
    QTest::newRow("shape of no blocks") << "a['shape'] = a['shape'] + 1"
                                        << "3x3";
    QTest::newRow("fewer rows") << "a['shape'] = a['shape'] - [3, 0]"
                                << "rows";
    QTest::newRow("fewer columns") << "a['shape'] = [a['shape'][0], 9]"
                                   << "outside";
    QTest::newRow("negative index") << "a['indices'][3] = -1"
                                    << "outside";
    QTest::newRow("unsorted") << "a['indices'][:2] = a['indices'][1::-1]"
                              << "ascend";
    QTest::newRow("rows going back") << "a['indptr'][3] = 0"
                                     << "indptr";
    QTest::newRow("rows beyond the end") << "a['indptr'][-1] += 1"
                                         << "indptr";
    QTest::newRow("not a number") << "a['data'][0,0,0] = n.nan"
                                  << "finite";
    QTest::newRow("beyond the scale") << "a['data'][0,0,0] = 1e30"
                                      << "scale";
    QTest::newRow("short scale") << "a['scale'] = a['scale'][1:]"
                                 << "'scale'";
    QTest::newRow("negative scale") << "a['scale'] = -a['scale']"
                                    << "scale";
    QTest::newRow("integers") << "a['data'] = a['data'].astype('i4')"
                              << "floating";
    QTest::newRow("fewer blocks") << "a['data'] = a['data'][1:]"
                                  << "'data'";
    QTest::newRow("fortran order") << "a['data'] = n.asfortranarray(a['data'])"
                                   << "kind";
  }
  void brokenFilesAreRefused() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    QFETCH(QString, change);
    QFETCH(QString, word);
    saveBlocks(path(), someBlocks());
    QString output;
    QVERIFY2(changeArrays(folder(), change, output), qPrintable(output));
    expectError(ErrorKind::format, word, [&] { loadBlocks(path()); });
  }

  void truncatedAndForeignFilesAreRefused_data() {
    QTest::addColumn<double>("share");
    for (double share : {0.0, 0.3, 0.9, 0.999}) QTest::addRow("%g of the file", share) << share;
  }
  void truncatedAndForeignFilesAreRefused() {
    QFETCH(double, share);
    saveBlocks(path(), someBlocks());
    std::string whole = readFile(path());
    writeFileAtomically(path(),
                        whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    expectError(ErrorKind::format, "NumPy", [&] { loadBlocks(path()); });
    writeFileAtomically(path(), "P6 8 8 255 this is a picture");
    expectError(ErrorKind::format, "NumPy", [&] { loadBlocks(path()); });
  }

  /// -32768 is no code, and codes mean nothing without their scale.
  void brokenCodesAreRefused_data() {
    QTest::addColumn<QString>("change");
    QTest::addColumn<QString>("word");
    QTest::newRow("beyond the scale") << "a['data'][3, 1, 2] = -32768"
                                      << "scale";
    QTest::newRow("no scale") << "del a['scale']"
                              << "scale";
    QTest::newRow("fewer blocks") << "a['data'] = a['data'][1:]"
                                  << "3x3 blocks";
  }
  void brokenCodesAreRefused() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    QFETCH(QString, change);
    QFETCH(QString, word);
    saveTransport(path(), someTransport(), StoredValues::codes);
    QString output;
    QVERIFY2(changeArrays(folder(), change, output), qPrintable(output));
    expectError(ErrorKind::format, word, [&] { loadTransport(path()); });
  }

  void brokenSharedColoursAreRefused_data() {
    QTest::addColumn<QString>("change");
    QTest::newRow("fewer rows of colours") << "a['mixing'] = a['mixing'][1:]";
    QTest::newRow("colours that are no blocks") << "a['mixing'] = a['mixing'][..., :2]";
    QTest::newRow("no colours") << "del a['mixing']";
    QTest::newRow("infinite colours") << "a['mixing'][3, 1, 2, 0] = n.inf";
    QTest::newRow("fewer factors") << "a['factor'] = a['factor'][1:]";
    QTest::newRow("factors of another type") << "a['factor'] = a['factor'].astype(n.float32)";
    QTest::newRow("a kind too many") << "a['kinds'][0, 1] = 3";
    QTest::newRow("a negative kind") << "a['kinds'][0, 1] = -1";
    QTest::newRow("ranges that do not ascend") << "a['kinds'][1, 0] = a['kinds'][0, 0]";
    QTest::newRow("columns without a kind") << "a['kinds'][-1, 0] -= 1";
    QTest::newRow("ranges beyond the columns") << "a['kinds'][-1, 0] += 1";
    QTest::newRow("no ranges") << "a['kinds'] = a['kinds'][:0]";
  }
  void brokenSharedColoursAreRefused() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    QFETCH(QString, change);
    saveTransport(path(), someSharedTransport(), StoredValues::codes);
    QString output;
    QVERIFY2(changeArrays(folder(), change, output), qPrintable(output));
    expectError(ErrorKind::format, "", [&] { loadTransport(path()); });
  }

  void damagedBytesAreFound() {
    saveBlocks(path(), someBlocks());
    std::string whole = readFile(path());
    std::string damaged = whole;
    std::size_t place = damaged.find("data.npy") + 1000;
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    writeFileAtomically(path(), damaged);
    try {
      loadBlocks(path());
      QFAIL("a changed byte went unnoticed");
    } catch (const Error& error) {
      QVERIFY2(error.kind() == ErrorKind::format, error.what());
    }
  }

  void devicesMustFitTheMatrix() {
    if (!scipyIsThere()) QSKIP("this machine has no SciPy");
    for (QString change : {"a['cameras'][0,0] = 6", "a['projectors'][0,0] = 0",
                           "a['projectors'] = a['projectors'][:0]", "del a['cameras']"}) {
      saveTransport(path(), someTransport());
      QString output;
      QVERIFY(changeArrays(folder(), change, output));
      expectError(ErrorKind::format, "", [&] { loadTransport(path()); });
    }
  }

  void missingFilesAndFoldersAreErrorsOfTheDisk() {
    expectError(ErrorKind::disk, "", [&] { loadBlocks(folder() / "none.npz"); });
    expectError(ErrorKind::disk, "", [&] { saveBlocks(folder() / "none" / "matrix.npz", someBlocks()); });
  }

  void fullExpansionIsTheSameTransport() {
    TransportMatrix transport = someTransport();
    PixelExpansion expansion = expandedToPixels(transport);
    QCOMPARE(expansion.sampledShare(), 0.0);
    ProjectorStack pattern(randomStack(transport.projectors().count(), 3));
    Stack expected = transport.apply(pattern);
    CameraStack seen(applied(expansion, pattern));
    for (std::size_t i = 0; i < seen.size(); ++i) QVERIFY(std::abs(seen[i] - expected[i]) < 1e-4f);
  }

  void samplesKeepTheLightWithinTheLimit_data() {
    QTest::addColumn<int>("side");
    for (int side : {1, 2, 3, 5}) QTest::addRow("side %d", side) << side;
  }
  void samplesKeepTheLightWithinTheLimit() {
    QFETCH(int, side);
    TransportMatrix transport = someTransport();
    // Just enough for this side: entries that fall on the same pixel only make it less.
    std::uint64_t blocks = 0;
    for (std::size_t entry = 0; entry < transport.ownLeaves().blocks(); ++entry) {
      Block block = transport.layout().block(transport.layout().node(transport.ownLeaves().column(entry)));
      blocks += static_cast<std::uint64_t>(std::min(side, block.x1 - block.x0) *
                                           std::min(side, block.y1 - block.y0));
    }
    PixelExpansion expansion = expandedToPixels(transport, {40 * blocks, 1});
    QCOMPARE(expansion.side(), side);
    QVERIFY(expansion.blocks() <= blocks);
    QVERIFY(expansion.sampledShare() > 0.0 && expansion.sampledShare() < 1.0);
    QVERIFY(QString::fromStdString(english(expansion.summary())).contains("sample"));
    ProjectorStack white(3 * transport.projectors().count(), 1.0f);
    Stack expected = transport.floodlight(), seen = applied(expansion, white);
    for (std::size_t i = 0; i < seen.size(); ++i) QVERIFY(std::abs(seen[i] - expected[i]) < 1e-4f);
  }

  void expansionsAreReadBack() {
    TransportMatrix transport = someTransport();
    PixelExpansion expansion = expandedToPixels(transport, {20000, 1});
    saveExpanded(path(), expansion);
    BlockSparse blocks = loadBlocks(path());
    QCOMPARE(blocks.columns(), transport.projectors().count());
    QCOMPARE(blocks.blocks(), expansion.blocks());
    std::vector<PixelExpansion::Entry> entries;
    for (std::size_t row = 0; row < blocks.rows(); ++row) {
      expansion.row(row, entries);
      QCOMPARE(blocks.rowBegin(row), expansion.rowBegin(row));
      for (std::size_t i = 0; i < entries.size(); ++i) {
        std::size_t entry = blocks.rowBegin(row) + i;
        QCOMPARE(blocks.column(entry), entries[i].column);
        QVERIFY((blocks.block(row, entry) - entries[i].value).cwiseAbs().maxCoeff() <=
                0.501f * blocks.scale(row));
      }
    }
  }

 private:
  fs::path folder() const { return folder_->path().toStdString(); }
  fs::path path() const { return folder() / "matrix.npz"; }

  static Stack applied(const PixelExpansion& expansion, const ProjectorStack& pattern) {
    CameraStack seen(3 * expansion.transport().cameras().count(), 0.0f);
    std::vector<PixelExpansion::Entry> entries;
    for (std::size_t row = 0; row < seen.size() / 3; ++row) {
      expansion.row(row, entries);
      for (const auto& entry : entries)
        Eigen::Map<Eigen::Vector3f>(&seen[3 * row]) +=
            entry.value *
            Eigen::Map<const Eigen::Vector3f>(&pattern[3 * static_cast<std::size_t>(entry.column)]);
    }
    return seen;
  }

  static void expectError(ErrorKind kind, const QString& word, const std::function<void()>& action) {
    try {
      action();
      QFAIL("nothing was thrown");
    } catch (const Error& error) {
      QVERIFY2(error.kind() == kind, error.what());
      QVERIFY2(QString(error.what()).contains(word), error.what());
      QVERIFY(!error.advice().empty());
    }
  }

  std::unique_ptr<QTemporaryDir> folder_;
};

QTEST_APPLESS_MAIN(TestFiles)
#include "test_files.moc"
