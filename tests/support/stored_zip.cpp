// SPDX-License-Identifier: MIT
#include "support/stored_zip.h"

#include <zip.h>
#include <zlib.h>

#include <cstdint>
#include <stdexcept>

namespace relucent::test {
namespace {

void append(std::string& bytes, std::uint64_t value, int width) {
  for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
}

/// What a member's own header and its entry in the list at the end have in common.
std::string description(const std::string& name, const std::string& content) {
  std::string bytes;
  append(bytes, 20, 2);           // version
  append(bytes, 0, 2);            // flags
  append(bytes, 0, 2);            // stored
  append(bytes, 0x00210000U, 4);  // the first of January 1980
  append(bytes, ::crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())),
         4);
  append(bytes, content.size(), 4);
  append(bytes, content.size(), 4);
  append(bytes, name.size(), 2);
  append(bytes, 0, 2);  // no more fields
  return bytes;
}

}  // namespace

std::string storedZip(const ZipMembers& members) {
  std::string archive, list;
  for (const auto& [name, content] : members) {
    const std::size_t offset = archive.size();
    const std::string described = description(name, content);
    append(archive, 0x04034b50U, 4);
    archive += described + name + content;
    append(list, 0x02014b50U, 4);
    append(list, 20, 2);
    list += described;
    append(list, 0, 2);  // no comment
    append(list, 0, 8);  // first disk, no attributes
    append(list, offset, 4);
    list += name;
  }
  const std::size_t begin = archive.size();
  archive += list;
  append(archive, 0x06054b50U, 4);
  append(archive, 0, 4);
  append(archive, members.size(), 2);
  append(archive, members.size(), 2);
  append(archive, list.size(), 4);
  append(archive, begin, 4);
  append(archive, 0, 2);
  return archive;
}

ZipMembers zipMembers(std::string_view archive) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(archive.data(), archive.size(), 0, &error);
  zip_t* zip = source != nullptr ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
  if (zip == nullptr) throw std::runtime_error("this is no archive");
  ZipMembers members;
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
    zip_stat_t stat;
    zip_stat_index(zip, static_cast<zip_uint64_t>(i), 0, &stat);
    std::string content(stat.size, '\0');
    zip_file_t* file = zip_fopen_index(zip, static_cast<zip_uint64_t>(i), 0);
    zip_fread(file, content.data(), content.size());
    zip_fclose(file);
    members.emplace_back(stat.name, std::move(content));
  }
  zip_discard(zip);
  return members;
}

}  // namespace relucent::test
