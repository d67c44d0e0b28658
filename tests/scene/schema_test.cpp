#include "scene/schema.hpp"

#include "scene/declaration.hpp"
#include "scene/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace cupel
{
namespace
{

using ::testing::HasSubstr;

void for_each_table(const Table& table, const std::function<void(const Table&)>& visit)
{
    visit(table);
    for (const Table& inner : table.tables)
        for_each_table(inner, visit);
}

TEST(Declarations, HaveAHelpTextAndAUnitThatParses)
{
    for_each_table(case_declaration(), [](const Table& table) {
        EXPECT_FALSE(table.help.empty()) << table.key;
        for (const Parameter& parameter : table.parameters) {
            EXPECT_FALSE(parameter.help.empty()) << table.key << "." << parameter.key;
            EXPECT_NO_THROW(parse_unit(parameter.unit)) << table.key << "." << parameter.key;
        }
    });
}

TEST(Declarations, AreInSIUnits)
{
    for_each_table(case_declaration(), [](const Table& table) {
        for (const Parameter& parameter : table.parameters) {
            const Unit unit = parse_unit(parameter.unit);
            EXPECT_EQ(unit.decimal_exponent, 0) << table.key << "." << parameter.key;
            EXPECT_EQ(unit.factor, 1) << table.key << "." << parameter.key;
        }
    });
}

TEST(Declarations, NameEachKeyOfATableOnce)
{
    for_each_table(case_declaration(), [](const Table& table) {
        std::set<std::string> seen;
        for (const Parameter& parameter : table.parameters)
            EXPECT_TRUE(seen.insert(parameter.key).second) << table.key << "." << parameter.key;
        for (const Table& inner : table.tables)
            EXPECT_TRUE(seen.insert(inner.key).second) << table.key << "." << inner.key;
    });
}

TEST(Schema, HasEveryDeclaredKey)
{
    const nlohmann::json schema = case_schema();
    for (const Table& table : case_declaration().tables)
        EXPECT_TRUE(schema.at("properties").contains(table.key)) << table.key;
    const auto& material = schema.at("properties").at("material").at("additionalProperties").at("properties");
    for (const Parameter& parameter : material_declaration().parameters)
        EXPECT_TRUE(material.contains(parameter.key)) << parameter.key;
    EXPECT_EQ(schema.at("additionalProperties"), false);
}

TEST(ParameterReference, ListsEveryKeyWithItsDefault)
{
    const std::string reference = parameter_reference();
    for_each_table(case_declaration(), [&](const Table& table) {
        for (const Parameter& parameter : table.parameters)
            EXPECT_THAT(reference, HasSubstr("| `" + parameter.key + "` |"));
    });
    EXPECT_THAT(reference,
                HasSubstr("| `artificial_stress` | number | ≥ 0, ≤ 1 | 0.0 (0.2 with the paper's formulation)"));
}

} // namespace
} // namespace cupel
