/* ocio.cpp -- OpenColorIO behind a C interface.
 *
 * OpenColorIO reports by exceptions and by a log of its own. Exceptions end in
 * `guarded`; the log is off while osdtex is inside (the level is a variable of
 * the whole process, hence the lock) unless the user set OCIO_LOGGING_LEVEL,
 * which OpenColorIO prefers to any program's wish. */
#include "bridge/ocio.h"

#include "bridge/builtin_config.h"

#include <OpenColorIO/OpenColorIO.h>

#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <new>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace OCIO = OCIO_NAMESPACE;

struct otx_ocio
{
    OCIO::ConstConfigRcPtr config;
    std::vector<const char *> names;
};

struct otx_ocio_conversion
{
    OCIO::ConstCPUProcessorRcPtr processor;
};

namespace
{

/* A configuration is text; studios' largest are a few MiB. */
constexpr std::uintmax_t config_max_bytes = 64u << 20;

/* Keeps OpenColorIO's log quiet in a scope. */
class quiet
{
  public:
    quiet() : m_lock(s_mutex), m_level(OCIO::GetLoggingLevel())
    {
        OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);
    }
    ~quiet()
    {
        OCIO::SetLoggingLevel(m_level);
    }
    quiet(const quiet &) = delete;
    quiet &operator=(const quiet &) = delete;

  private:
    static std::mutex s_mutex;
    std::lock_guard<std::mutex> m_lock;
    OCIO::LoggingLevel m_level;
};

std::mutex quiet::s_mutex;

/* OpenColorIO's messages span lines, and open with the path and "Error:";
 * the caller's finding says which file. */
void
say(char *message, const char *text)
{
    static const char *const openings[] = {
        "' failed. ", "Config failed validation. "};
    size_t used = 0;
    bool space = false;

    for (const char *opening : openings)
        if (const char *at = std::strstr(text, opening))
            text = at + std::strlen(opening);
    for (const char *c = text; *c; ++c)
    {
        if (std::isspace(static_cast<unsigned char>(*c)))
        {
            space = used > 0;
            continue;
        }
        if (used + 3 > OTX_OCIO_MESSAGE_BYTES)
            break;
        if (space)
            message[used++] = ' ';
        message[used++] = *c;
        space = false;
    }
    while (used > 0 && message[used - 1] == '.')
        --used;
    message[used] = '\0';
}

template <typename Body>
otx_status
guarded(char *message, Body body) noexcept
{
    message[0] = '\0';
    try
    {
        body();
        return OSDTEX_OK;
    }
    catch (const std::bad_alloc &)
    {
        say(message, "memory is out");
        return OSDTEX_ERROR_MEMORY;
    }
    catch (const std::exception &e)
    {
        say(message, e.what());
    }
    catch (...)
    {
        say(message, "OpenColorIO failed without saying why");
    }
    return OSDTEX_ERROR_COLOUR;
}

/* For questions whose failure means "no". */
template <typename Value, typename Body>
Value
answered(Value otherwise, Body body) noexcept
{
    try
    {
        return body();
    }
    catch (...)
    {
        return otherwise;
    }
}

std::string
read_text(const char *path)
{
    namespace fs = std::filesystem;

    /* Neither a folder nor a pipe, on which reading would hang. */
    if (!fs::exists(path))
        throw std::runtime_error("the file does not exist");
    if (!fs::is_regular_file(path))
        throw std::runtime_error("it is not a file");
    if (fs::file_size(path) > config_max_bytes)
        throw std::runtime_error("it is larger than 64 MiB");

    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file)
        throw std::runtime_error("it cannot be read, or is empty");
    return text.str();
}

/* Kinds of file that OpenColorIO refuses in words that help nobody. */
void
check_kind(const std::string &text)
{
#if OCIO_VERSION_HEX < 0x02020000
    if (text.compare(0, 4, "PK\3\4") == 0)
        throw std::runtime_error(
            "it is an .ocioz archive, which needs OpenColorIO 2.2: unpack it "
            "and give its config.ocio");
#endif
    const size_t at = text.find("ocio_profile_version:");
    if (at == std::string::npos)
        throw std::runtime_error(
            "it has no ocio_profile_version, so it is no configuration");

    int major = 0;
    int minor = 0;
    char dot = 0;
    std::istringstream version(text.substr(at + 21, 16));
    version >> major >> dot >> minor;
    if (major > OCIO_VERSION_MAJOR ||
        (major == OCIO_VERSION_MAJOR && minor > OCIO_VERSION_MINOR))
        throw std::runtime_error(
            "it has version " + std::to_string(major) + "." +
            std::to_string(minor) + ", but OpenColorIO " + OCIO::GetVersion() +
            " reads up to " + std::to_string(OCIO_VERSION_MAJOR) + "." +
            std::to_string(OCIO_VERSION_MINOR) +
            ": use an older release of the configuration");
}

/* A role that names nothing is the mark of a file cut short. */
void
check_roles(const OCIO::ConstConfigRcPtr &config)
{
    if (config->getNumColorSpaces() == 0)
        throw std::runtime_error("it defines no colour space");
    for (int i = 0; i < config->getNumRoles(); ++i)
    {
        const char *space = config->getRoleColorSpace(i);
        if (!config->getColorSpace(space))
            throw std::runtime_error(
                std::string("its role ") + config->getRoleName(i) +
                " names the space '" + space +
                "', which it does not define: is the file complete?");
    }
}

const char *
space_name(const OCIO::Config &config, int index)
{
    return config.getColorSpaceNameByIndex(
        OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL, index);
}

int
space_count(const OCIO::Config &config)
{
    return config.getNumColorSpaces(
        OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL);
}

/* See otx_ocio_name. The strings belong to the configuration. */
std::vector<const char *>
all_names(const OCIO::Config &config)
{
    std::vector<const char *> names;

    for (int i = 0; i < space_count(config); ++i)
        names.push_back(space_name(config, i));
    for (int i = 0; i < space_count(config); ++i)
        if (const auto space = config.getColorSpace(space_name(config, i)))
            for (size_t k = 0; k < space->getNumAliases(); ++k)
                names.push_back(space->getAlias(k));
    for (int i = 0; i < config.getNumRoles(); ++i)
        names.push_back(config.getRoleName(i));
    return names;
}

const char *
find(const OCIO::Config &config, const char *name)
{
    if (!name || !name[0])
        return nullptr;
    const auto space = config.getColorSpace(name);
    return space ? space->getName() : nullptr;
}

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
otx_ocio_open(const char *path, otx_ocio **out, char *message)
{
    *out = nullptr;
    return guarded(
        message,
        [&]
        {
            const quiet hush;
            check_kind(read_text(path));
            const auto config = OCIO::Config::CreateFromFile(path);
            check_roles(config);
            *out = new otx_ocio{config, all_names(*config)};
        });
}

bool
otx_ocio_is_carried(const char *path)
{
    return std::strncmp(path, "ocio://", 7) == 0;
}

#if OCIO_VERSION_HEX < 0x02020000
namespace
{

/* Those that OpenColorIO carries are ACES, each with ACEScg as scene_linear. */
OCIO::ConstConfigRcPtr
open_instead(const char *path)
{
    static const char own[] = "scene_linear: Linear Rec.709 (sRGB)";
    std::string text(builtin_config);
    const std::string name(path + 7);

    if (name != "default" && name.rfind("cg-config-", 0) != 0 &&
        name.rfind("studio-config-", 0) != 0)
        throw std::runtime_error(
            "OpenColorIO " + std::string(OCIO::GetVersion()) +
            " carries no configurations of its own, which 2.2 and later do: "
            "give the file of the configuration");
    text.replace(text.find(own), sizeof own - 1, "scene_linear: ACEScg");

    std::istringstream stream(text);
    return OCIO::Config::CreateFromStream(stream);
}

} // namespace
#endif

otx_status
otx_ocio_open_carried(
    const char *path, otx_ocio **out, char *message, char *stands_in)
{
    *out = nullptr;
    stands_in[0] = '\0';
    return guarded(
        message,
        [&]
        {
            const quiet hush;
#if OCIO_VERSION_HEX < 0x02020000
            const auto config = open_instead(path);
            say(stands_in, OCIO::GetVersion());
#else
            const auto config = OCIO::Config::CreateFromFile(path);
#endif
            *out = new otx_ocio{config, all_names(*config)};
        });
}

otx_status
otx_ocio_open_builtin(otx_ocio **out, char *message)
{
    *out = nullptr;
    return guarded(
        message,
        [&]
        {
            const quiet hush;
            std::istringstream text(builtin_config);
            const auto config = OCIO::Config::CreateFromStream(text);
            *out = new otx_ocio{config, all_names(*config)};
        });
}

void
otx_ocio_close(otx_ocio *ocio)
{
    delete ocio;
}

otx_status
otx_ocio_validate(const otx_ocio *ocio, char *message)
{
    const otx_status status = guarded(
        message,
        [&]
        {
            const quiet hush;
            ocio->config->validate();
        });
    /* All that 2.1 says of a file it cannot find. */
    if (std::strcmp(message, "Config failed sanitycheck") == 0)
        say(message, "a look-up table that it names is not found");
    return status;
}

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

int32_t
otx_ocio_space_count(const otx_ocio *ocio)
{
    return answered<int32_t>(0, [&] { return space_count(*ocio->config); });
}

const char *
otx_ocio_space_name(const otx_ocio *ocio, int32_t index)
{
    return answered<const char *>(
        "", [&] { return space_name(*ocio->config, index); });
}

const char *
otx_ocio_find(const otx_ocio *ocio, const char *name)
{
    return answered<const char *>(
        nullptr, [&] { return find(*ocio->config, name); });
}

const char *
otx_ocio_role(const otx_ocio *ocio, const char *role)
{
    return answered<const char *>(
        nullptr,
        [&]() -> const char * {
            return ocio->config->hasRole(role) ? find(*ocio->config, role)
                                               : nullptr;
        });
}

const char *
otx_ocio_role_name(const otx_ocio *ocio, int32_t index)
{
    return answered<const char *>(
        nullptr,
        [&]() -> const char *
        {
            return index >= 0 && index < ocio->config->getNumRoles()
                       ? ocio->config->getRoleName(index)
                       : nullptr;
        });
}

const char *
otx_ocio_alias(const otx_ocio *ocio, const char *space, int32_t index)
{
    return answered<const char *>(
        nullptr,
        [&]() -> const char *
        {
            const auto found = ocio->config->getColorSpace(space);
            return found && index >= 0 &&
                           static_cast<size_t>(index) < found->getNumAliases()
                       ? found->getAlias(static_cast<size_t>(index))
                       : nullptr;
        });
}

const char *
otx_ocio_display(const otx_ocio *ocio, int32_t index)
{
    return answered<const char *>(
        nullptr,
        [&]() -> const char *
        {
            return index >= 0 && index < ocio->config->getNumDisplays()
                       ? ocio->config->getDisplay(index)
                       : nullptr;
        });
}

const char *
otx_ocio_view(const otx_ocio *ocio, const char *display, int32_t index)
{
    return answered<const char *>(
        nullptr,
        [&]() -> const char *
        {
            return index >= 0 && index < ocio->config->getNumViews(display)
                       ? ocio->config->getView(display, index)
                       : nullptr;
        });
}

const char *
otx_ocio_name(const otx_ocio *ocio, int32_t index)
{
    if (index < 0 || static_cast<size_t>(index) >= ocio->names.size())
        return nullptr;
    return ocio->names[static_cast<size_t>(index)];
}

bool
otx_ocio_is_data(const otx_ocio *ocio, const char *space)
{
    return answered<bool>(
        false,
        [&]
        {
            const auto found = ocio->config->getColorSpace(space);
            return found && found->isData();
        });
}

const char *
otx_ocio_encoding(const otx_ocio *ocio, const char *space)
{
    return answered<const char *>(
        "",
        [&]
        {
            const auto found = ocio->config->getColorSpace(space);
            return found ? found->getEncoding() : "";
        });
}

const char *
otx_ocio_file_rule(const otx_ocio *ocio, const char *path, const char **rule)
{
    *rule = nullptr;
    return answered<const char *>(
        nullptr,
        [&]() -> const char *
        {
            const quiet hush;
            const auto rules = ocio->config->getFileRules();
            size_t index = 0;
            const char *space =
                ocio->config->getColorSpaceFromFilepath(path, index);
            /* The Default rule is always the last. */
            if (index + 1 >= rules->getNumEntries())
                return nullptr;
            *rule = rules->getName(index);
            return find(*ocio->config, space);
        });
}

otx_status
otx_ocio_convert(
    const otx_ocio *ocio, const char *from, const char *to,
    otx_ocio_conversion **out, char *message)
{
    *out = nullptr;
    return guarded(
        message,
        [&]
        {
            const quiet hush;
            const auto processor = ocio->config->getProcessor(from, to);
            /* Lossless: the default replaces powers by a fast approximation. */
            *out = new otx_ocio_conversion{processor->getOptimizedCPUProcessor(
                OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32,
                OCIO::OPTIMIZATION_LOSSLESS)};
        });
}

void
otx_ocio_conversion_destroy(otx_ocio_conversion *conversion)
{
    delete conversion;
}

bool
otx_ocio_conversion_is_identity(const otx_ocio_conversion *conversion)
{
    return answered<bool>(
        false, [&] { return conversion->processor->isNoOp(); });
}

otx_status
otx_ocio_conversion_apply(
    const otx_ocio_conversion *conversion, float *pixels, int64_t count,
    int32_t channels, char *message)
{
    return guarded(
        message,
        [&]
        {
            if (count <= 0)
                return;
            OCIO::PackedImageDesc image(
                pixels, static_cast<long>(count), 1, channels);
            conversion->processor->apply(image);
        });
}
