#pragma once

#include <QFile>
#include <QTemporaryDir>
#include <string>

#include "case/schema.hpp"

namespace breccia::gui::test {

/// A case that has something in every section of the table of keys; it need not run.
inline QString everything(const QTemporaryDir& scratch) {
  const QString file = scratch.filePath("everything.toml");
  QFile out(file);
  if (!out.open(QIODevice::WriteOnly)) return {};
  for (const case_::Key& key : case_::schema()) {
    if (key.path.starts_with('<')) continue;
    if (key.is_section()) {
      out.write(("\n" + case_::header_of(key) + "\n").c_str());
    } else {
      out.write((std::string(key.name()) + " = " + std::string(key.example) + "\n").c_str());
    }
  }
  return file;
}

}  // namespace breccia::gui::test
