#include "core/contact_pairs.hpp"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

namespace breccia::gui::contact_pairs_test {
namespace {

/// A case with contacts of these pairs.
void open_case(Document& document, const QTemporaryDir& scratch, const QStringList& pairs) {
  QFile out(scratch.filePath("case.toml"));
  ASSERT_TRUE(out.open(QIODevice::WriteOnly));
  for (const char* group : {"a", "b", "c"}) out.write(QByteArray("[[material]]\ngroup = \"") + group + "\"\n");
  for (const QString& pair : pairs)
    out.write("[[contact]]\nbetween = " + pair.toUtf8() + "\npenalty = \"2 GPa\"  # of it\n");
  out.close();
  ASSERT_TRUE(document.open(scratch.filePath("case.toml")).isEmpty());
}

TEST(ContactPairs, TheEntryThatNamesMoreGroupsHoldsAndOfTheseTheLaterOne) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  open_case(document, scratch, {R"(["*", "*"])", R"(["b", "a"])", R"(["*", "c"])", R"(["c", "*"])", R"(["*", "*"])"});
  bool own = false;
  EXPECT_EQ(groups_of(document), (QStringList{"a", "b", "c"}));
  EXPECT_EQ(contact_of(document, "a", "b", &own), "contact[1]");
  EXPECT_TRUE(own);
  EXPECT_EQ(contact_of(document, "c", "a", &own), "contact[3]");
  EXPECT_FALSE(own);
  EXPECT_EQ(contact_of(document, "a", "a", &own), "contact[4]");
}

TEST(ContactPairs, AGroupWithoutAMaterialOfItsOwnHasThatOfAny) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  open_case(document, scratch, {});
  EXPECT_EQ(material_entry_of(document, "b"), "material[1]");
  EXPECT_EQ(material_entry_of(document, "d"), "");
  document.set_value("material[0].group", "\"*\"");
  EXPECT_EQ(material_entry_of(document, "b"), "material[1]");
  EXPECT_EQ(material_entry_of(document, "d"), "material[0]");
}

TEST(ContactPairs, WithoutAnEntryThereIsNoContactUntilOneIsGiven) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  open_case(document, scratch, {R"(["a", "*"])"});
  bool own = false;
  EXPECT_TRUE(contact_of(document, "b", "c", &own).isEmpty());
  EXPECT_FALSE(own);
  EXPECT_EQ(give_own_contact(document, "b", "c"), "contact[1]");
  EXPECT_TRUE(document.value("contact[1].penalty").isEmpty()) << "an invented stiffness looks like one that was meant";
  EXPECT_EQ(give_own_contact(document, "c", "b"), "contact[1]") << "it has one";
  EXPECT_EQ(give_own_contact(document, "a", "b"), "contact[2]");
  EXPECT_EQ(document.value("contact[2].penalty"), "\"2 GPa\"");
}

}  // namespace
}  // namespace breccia::gui::contact_pairs_test
