// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <vector>

namespace relucent::reference {

/// Least squares in the box [0, 1] that SciPy solved: tests/data/box_least_squares.py.
struct BoxCase {
  QString name;
  Eigen::MatrixXd codes;  // A = codes / 32767
  Eigen::VectorXd b;      // not weighted
  Eigen::VectorXd x;
  double objective = 0.0;
  bool unique = false;  // x is the only optimum
  QJsonObject json;

  Eigen::MatrixXd a() const { return codes / 32767.0; }
};

inline std::vector<double> numbers(const QJsonValue& array) {
  std::vector<double> result;
  for (const QJsonValue& value : array.toArray()) result.push_back(value.toDouble());
  return result;
}

inline Eigen::VectorXd vectorOf(const QJsonValue& array) {
  std::vector<double> values = numbers(array);
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// `kind`: "dense" or "transport". From the folder that ctest names; by hand, from the root of the sources.
inline std::vector<BoxCase> boxCases(const char* kind) {
  QFile opened(qEnvironmentVariable("RELUCENT_TEST_DATA", "tests/data") + "/box_least_squares.json");
  if (!opened.open(QIODevice::ReadOnly)) return {};
  std::vector<BoxCase> cases;
  for (const QJsonValue& value : QJsonDocument::fromJson(opened.readAll()).object()[kind].toArray()) {
    QJsonObject json = value.toObject();
    BoxCase made{
        json["name"].toString(), {},  vectorOf(json["b"]), vectorOf(json["x"]), json["objective"].toDouble(),
        json["unique"].toBool(), json};
    std::vector<double> codes = numbers(json["codes"]);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    made.codes = Eigen::Map<RowMajor>(codes.data(), json["rows"].toInt(), json["columns"].toInt());
    cases.push_back(std::move(made));
  }
  return cases;
}

}  // namespace relucent::reference
