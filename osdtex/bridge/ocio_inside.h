/* ocio_inside.h -- what the files behind ocio.h share.
 *
 * OpenColorIO reports by exceptions and by a log of its own. Exceptions end in
 * `guarded`; the log is off while osdtex is inside (the level is a variable of
 * the whole process, hence the lock) unless the user set OCIO_LOGGING_LEVEL,
 * which OpenColorIO prefers to any program's wish. */
#ifndef OTX_BRIDGE_OCIO_INSIDE_H
#define OTX_BRIDGE_OCIO_INSIDE_H

#include "bridge/ocio.h"

#include <OpenColorIO/OpenColorIO.h>

#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace OCIO = OCIO_NAMESPACE;

struct otx_ocio
{
    OCIO::ConstConfigRcPtr config;
    std::vector<const char *> names; /* see otx_ocio_name */
};

namespace ocio_inside
{

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
    inline static std::mutex s_mutex;
    std::lock_guard<std::mutex> m_lock;
    OCIO::LoggingLevel m_level;
};

/* Puts what OpenColorIO says into one line of OTX_OCIO_MESSAGE_BYTES. */
void say(char *message, const char *text);

/* The text of a file, which must be one and no larger than 64 MiB. */
std::string read_text(const char *path);

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

/* The proper name of a space; NULL when there is none. */
inline const char *
find(const OCIO::Config &config, const char *name)
{
    if (!name || !name[0])
        return nullptr;
    const auto space = config.getColorSpace(name);
    return space ? space->getName() : nullptr;
}

/* Spaces of all kinds, active or not. */
inline const char *
space_name(const OCIO::Config &config, int index)
{
    return config.getColorSpaceNameByIndex(
        OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL, index);
}

inline int
space_count(const OCIO::Config &config)
{
    return config.getNumColorSpaces(
        OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL);
}

/* Everything that a space may be called by. The strings belong to the
 * configuration. */
std::vector<const char *> all_names(const OCIO::Config &config);

} // namespace ocio_inside

#endif
