// SPDX-License-Identifier: MIT
#include "relucent/mapping/mpcdi.h"

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::mapping;

namespace {

/// Reads the archive with nothing of ours: Python's own zip, XML and numbers. Prints a line for each region
/// and for each of its pixels.
constexpr const char* reader = R"(
import struct, sys, zipfile
import xml.etree.ElementTree as tree
archive = zipfile.ZipFile(sys.argv[1])
root = tree.fromstring(archive.read('mpcdi.xml'))
assert root.tag == 'MPCDI' and root.get('profile') == '2d' and root.get('version') == '1.0'
buffer = root.find('display/buffer')
print('buffer', buffer.get('Xresolution'), buffer.get('Yresolution'))
for region in buffer.iter('region'):
    files = [f for f in root.find('files').iter('fileset') if f.get('region') == region.get('id')]
    assert len(files) == 1
    assert [region.get(k) for k in ('x', 'y', 'xsize', 'ysize')] == ['0', '0', '1', '1']
    warp, alpha = files[0].find('geometryWarpFile'), files[0].find('alphaMap')
    assert warp.find('interpolation').text == 'linear' and alpha.find('gammaEmbedded').text == '1.0'
    kind, size, scale, data = archive.read(warp.find('path').text).split(b'\n', 3)
    width, height = map(int, size.split())
    assert kind == b'PF' and float(scale) < 0 and len(data) == 12 * width * height
    png = archive.read(alpha.find('path').text)
    assert png[:8] == b'\x89PNG\r\n\x1a\n' and struct.unpack('>IIBB', png[16:26]) == (width, height, 16, 2)
    print('region', region.get('Xresolution'), region.get('Yresolution'), width, height)
    for y in range(height):
        for x in range(width):
            # Lines from below.
            print(*struct.unpack_from('<ff', data, 12 * ((height - 1 - y) * width + x)))
)";

ProjectorMaps someMaps(const std::vector<Size>& sizes) {
  ProjectorMaps maps;
  maps.projectors = Rasters(sizes);
  Random random{3};
  for (std::size_t j = 0; j < maps.projectors.count(); ++j) {
    maps.place.push_back({static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
    for (int c = 0; c < 3; ++c) maps.alpha.push_back(static_cast<float>(random.uniform()));
  }
  return maps;
}

}  // namespace

class TestMpcdi : public QObject {
  Q_OBJECT

 private slots:
  void anotherReaderFindsEveryPlace_data() {
    QTest::addColumn<int>("projectors");
    QTest::newRow("one projector") << 1;
    QTest::newRow("three projectors") << 3;
  }
  void anotherReaderFindsEveryPlace() {
    QFETCH(int, projectors);
    std::vector<Size> sizes{{13, 7}, {8, 6}, {5, 9}};
    sizes.resize(static_cast<std::size_t>(projectors));
    const ProjectorMaps maps = someMaps(sizes);
    constexpr Size canvas{1920, 1080};
    QTemporaryDir folder;
    const QString path = folder.filePath("venue.mpcdi");
    writeMpcdi(path.toStdString(), maps, canvas, "2026-01-31 12:00:00");
    QProcess python;
    python.start("/usr/bin/python3", {"-I", "-c", reader, path});
    QVERIFY(python.waitForFinished());
    QVERIFY2(python.exitCode() == 0, python.readAllStandardError());
    const QStringList lines = QString::fromUtf8(python.readAllStandardOutput()).trimmed().split('\n');
    qsizetype line = 0;
    QCOMPARE(lines[line++], QString("buffer 1920 1080"));
    std::size_t j = 0;
    for (const Size& size : sizes) {
      QCOMPARE(lines[line++], QString("region %1 %2 %1 %2").arg(size.width).arg(size.height));
      for (std::size_t i = 0; i < size.count(); ++i, ++j) {
        const QStringList place = lines[line++].split(' ');
        // A place is the same within half a pixel of the content, and better.
        QVERIFY(std::abs(place[0].toDouble() - static_cast<double>(maps.place[j][0])) * canvas.width < 1e-3);
        QVERIFY(std::abs(place[1].toDouble() - static_cast<double>(maps.place[j][1])) * canvas.height < 1e-3);
      }
    }
    QCOMPARE(line, lines.size());
  }

  void theSameMapsGiveTheSameBytes() {
    QTemporaryDir folder;
    const ProjectorMaps maps = someMaps({{13, 7}});
    QByteArrayList bytes;
    for (const char* name : {"a.mpcdi", "b.mpcdi"}) {
      writeMpcdi(folder.filePath(name).toStdString(), maps, {640, 480}, "2026-01-31 12:00:00");
      QFile file(folder.filePath(name));
      QVERIFY(file.open(QFile::ReadOnly));
      bytes.append(file.readAll());
    }
    QCOMPARE(bytes[0], bytes[1]);
  }
};

QTEST_APPLESS_MAIN(TestMpcdi)
#include "test_mpcdi.moc"
