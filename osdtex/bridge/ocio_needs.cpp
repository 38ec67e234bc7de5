/* ocio_needs.cpp -- what the conversions of a configuration depend on: its
 * text, variables, and tables with those that they refer to. */
#include "bridge/ocio_inside.h"

#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace ocio_inside;

namespace
{

using visitor = void (*)(void *user, otx_ocio_need need, const char *text);

/* Names of the tables in a transform and those it is made of. */
void
collect_tables(
    const OCIO::ConstTransformRcPtr &transform, std::set<std::string> &tables)
{
    if (const auto file =
            OCIO_DYNAMIC_POINTER_CAST<const OCIO::FileTransform>(transform))
        tables.insert(file->getSrc());
    if (const auto group =
            OCIO_DYNAMIC_POINTER_CAST<const OCIO::GroupTransform>(transform))
        for (int i = 0; i < group->getNumTransforms(); ++i)
            collect_tables(group->getTransform(i), tables);
}

std::set<std::string>
tables_of(const OCIO::Config &config)
{
    std::set<std::string> tables;

    for (int i = 0; i < space_count(config); ++i)
        if (const auto s = config.getColorSpace(space_name(config, i)))
            for (const auto direction :
                 {OCIO::COLORSPACE_DIR_TO_REFERENCE,
                  OCIO::COLORSPACE_DIR_FROM_REFERENCE})
                collect_tables(s->getTransform(direction), tables);
    for (int i = 0; i < config.getNumLooks(); ++i)
        if (const auto l = config.getLook(config.getLookNameByIndex(i)))
        {
            collect_tables(l->getTransform(), tables);
            collect_tables(l->getInverseTransform(), tables);
        }
    for (int i = 0; i < config.getNumViewTransforms(); ++i)
        if (const auto v =
                config.getViewTransform(config.getViewTransformNameByIndex(i)))
            for (const auto direction :
                 {OCIO::VIEWTRANSFORM_DIR_TO_REFERENCE,
                  OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE})
                collect_tables(v->getTransform(direction), tables);
    for (int i = 0; i < config.getNumNamedTransforms(OCIO::NAMEDTRANSFORM_ALL);
         ++i)
        if (const auto n =
                config.getNamedTransform(config.getNamedTransformNameByIndex(
                    OCIO::NAMEDTRANSFORM_ALL, i)))
            for (const auto direction :
                 {OCIO::TRANSFORM_DIR_FORWARD, OCIO::TRANSFORM_DIR_INVERSE})
                collect_tables(n->getTransform(direction), tables);
    return tables;
}

/* Variables that stand in a text as $NAME, ${NAME} or %NAME%. */
std::set<std::string>
variables_in(const std::string &text)
{
    const auto is_letter = [](char c)
    { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    std::set<std::string> names;

    for (size_t i = 0; i + 1 < text.size(); ++i)
    {
        if (text[i] != '$' && text[i] != '%')
            continue;
        const size_t begin = i + 1 + (text[i] == '$' && text[i + 1] == '{');
        size_t end = begin;

        while (end < text.size() && is_letter(text[end]))
            ++end;
        if (end > begin &&
            (text[i] == '$' || (end < text.size() && text[end] == '%')))
            names.insert(text.substr(begin, end - begin));
    }
    return names;
}

/* "" where it is not found. */
std::string
place_of(const OCIO::ConstContextRcPtr &context, const std::string &table)
{
    return answered<std::string>(
        "", [&] { return context->resolveFileLocation(table.c_str()); });
}

/* What an attribute says, with the five characters that XML escapes. */
std::string
unescape(std::string text)
{
    static const char *const escapes[][2] = {
        {"&lt;", "<"},
        {"&gt;", ">"},
        {"&quot;", "\""},
        {"&apos;", "'"},
        {"&amp;", "&"}};

    for (const auto &escape : escapes)
        for (size_t at = 0;
             (at = text.find(escape[0], at)) != std::string::npos; ++at)
            text.replace(at, std::strlen(escape[0]), escape[1]);
    return text;
}

/* The attribute of an element, or "". */
std::string
attribute(const std::string &element, const std::string &name)
{
    for (const char quote : {'"', '\''})
    {
        const std::string opening = " " + name + "=" + quote;
        const size_t at = element.find(opening);

        if (at == std::string::npos)
            continue;
        const size_t begin = at + opening.size();
        return unescape(
            element.substr(begin, element.find(quote, begin) - begin));
    }
    return "";
}

/* Adds the tables that a table refers to: a CTF may be made of others. */
void
collect_references(const std::string &place, std::vector<std::string> &tables)
{
    const std::string text =
        answered<std::string>("", [&] { return read_text(place.c_str()); });
    size_t at = text.find("<ProcessList");

    while (at != std::string::npos &&
           (at = text.find("<Reference", at)) != std::string::npos)
    {
        const size_t end = text.find('>', at);
        const std::string path = attribute(text.substr(at, end - at), "path");

        if (!path.empty())
            tables.push_back(path);
        at = end;
    }
}

/* All tables by name, with what they refer to behind them. */
std::vector<std::string>
all_tables(const OCIO::Config &config, const OCIO::ConstContextRcPtr &context)
{
    const std::set<std::string> named = tables_of(config);
    std::vector<std::string> tables(named.begin(), named.end());
    std::set<std::string> places;

    for (size_t i = 0; i < tables.size(); ++i)
    {
        const std::string place = place_of(context, tables[i]);

        if (!place.empty() && places.insert(place).second)
            collect_references(place, tables);
    }
    return tables;
}

void
visit_needs(const OCIO::Config &config, visitor visit, void *user)
{
    const auto context = config.getCurrentContext();
    std::ostringstream text;

    config.serialize(text);
    visit(user, OTX_OCIO_NEED_TEXT, OCIO::GetVersion());
    visit(user, OTX_OCIO_NEED_TEXT, text.str().c_str());
    for (const std::string &name : variables_in(text.str()))
    {
        const std::string value =
            context->resolveStringVar(("${" + name + "}").c_str());
        visit(user, OTX_OCIO_NEED_VARIABLE, (name + "=" + value).c_str());
    }
    for (const std::string &table : all_tables(config, context))
    {
        const std::string place = place_of(context, table);
        visit(user, OTX_OCIO_NEED_NAME, table.c_str());
        if (!place.empty())
            visit(user, OTX_OCIO_NEED_FILE, place.c_str());
    }
}

} // namespace

otx_status
otx_ocio_visit_needs(
    const otx_ocio *ocio, visitor visit, void *user, char *message)
{
    return guarded(
        message,
        [&]
        {
            const quiet hush;
            visit_needs(*ocio->config, visit, user);
        });
}
