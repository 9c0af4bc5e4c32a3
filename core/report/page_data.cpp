// SPDX-License-Identifier: MIT
#include "relucent/report/page_data.h"

#include "relucent/report/pictures.h"

namespace relucent::report {

PageData named(const std::string& name, const std::string& value) {
  PageData item;
  item.set("name", name);
  item.set("value", value);
  return item;
}

PageData figure(const image::Image& encoded, const std::string& name, const std::string& caption,
                const std::string& below) {
  PageData item;
  item.set("picture", pngDataUri(encoded));
  item.set("width", std::to_string(encoded.width()));
  item.set("height", std::to_string(encoded.height()));
  item.set("name", name);
  item.set("caption", caption);
  item.set("below", below);
  return item;
}

}  // namespace relucent::report
