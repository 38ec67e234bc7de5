/* ocio_names.cpp -- what a configuration calls its spaces, and says of them. */
#include "bridge/ocio_inside.h"

using namespace ocio_inside;

std::vector<const char *>
ocio_inside::all_names(const OCIO::Config &config)
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
