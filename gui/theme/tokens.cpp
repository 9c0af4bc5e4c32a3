// SPDX-License-Identifier: MIT
#include "theme/tokens.h"

namespace relucent::gui {

const Colours& colours(Look look) {
  static const Colours dark{
      .window = QColor("#131110"),
      .rail = QColor("#191614"),
      .card = QColor("#1F1B18"),
      .raised = QColor("#282320"),
      .input = QColor("#161311"),
      .line = QColor("#37302A"),
      .border = QColor("#7C7064"),
      .text = QColor("#DCD2C6"),
      .secondary = QColor("#AEA294"),
      .disabled = QColor("#9C9184"),
      .accent = QColor("#E29163"),
      .accentGround = QColor("#3A2519"),
      .onAccent = QColor("#1B100A"),
      .good = QColor("#86B892"),
      .amber = QColor("#E3B94F"),
      .amberGround = QColor("#33290F"),
      .error = QColor("#EC7F76"),
      .errorGround = QColor("#3B1B18"),
      .information = QColor("#8FB3D6"),
      .informationGround = QColor("#18232E"),
      .picture = QColor("#0B0A09"),
      .red = QColor("#EC7F76"),
      .green = QColor("#86B892"),
      .blue = QColor("#84B0E6"),
  };
  static const Colours light{
      .window = QColor("#ECE7E0"),
      .rail = QColor("#E3DDD4"),
      .card = QColor("#F7F4EF"),
      .raised = QColor("#FFFDFA"),
      .input = QColor("#FFFDFA"),
      .line = QColor("#D2C9BD"),
      .border = QColor("#857868"),
      .text = QColor("#2A241F"),
      .secondary = QColor("#574D43"),
      .disabled = QColor("#665B50"),
      .accent = QColor("#9A4517"),
      .accentGround = QColor("#F5DDCE"),
      .onAccent = QColor("#FFFFFF"),
      .good = QColor("#2B6538"),
      .amber = QColor("#6F4E00"),
      .amberGround = QColor("#F9ECC6"),
      .error = QColor("#A02C24"),
      .errorGround = QColor("#FAE0DD"),
      .information = QColor("#28578A"),
      .informationGround = QColor("#DFEAF5"),
      .picture = QColor("#0B0A09"),
      .red = QColor("#B3362C"),
      .green = QColor("#2B6538"),
      .blue = QColor("#28578A"),
  };
  return look == Look::dark ? dark : light;
}

}  // namespace relucent::gui
