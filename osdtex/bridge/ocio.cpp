/* ocio.cpp -- opening configurations, and converting pixels with them. */
#include "bridge/ocio_inside.h"

#include "bridge/builtin_config.h"

#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace ocio_inside;

struct otx_ocio_conversion
{
    OCIO::ConstCPUProcessorRcPtr processor;
};

/* OpenColorIO's messages span lines, and open with the path and "Error:";
 * the caller's finding says which file. */
void
ocio_inside::say(char *message, const char *text)
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

namespace
{

/* A configuration is text; studios' largest are a few MiB. */
constexpr std::uintmax_t config_max_bytes = 64u << 20;

} // namespace

std::string
ocio_inside::read_text(const char *path)
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

namespace
{

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

bool
otx_ocio_conversion_is_apart(const otx_ocio_conversion *conversion)
{
    return answered<bool>(
        false, [&] { return !conversion->processor->hasChannelCrosstalk(); });
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
