/* openexr.cpp -- what OpenEXR reads in C++ only, for C.
 *
 * Rows come one at a time into a buffer of one row: OpenEXR keeps the block
 * that it decompressed last. No thread of OpenEXR's own is used. */
#include "bridge/openexr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>

#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

namespace
{

struct window
{
    int32_t x_min, width;
};

window
window_of(const Imath::Box2i &box)
{
    return {box.min.x, box.max.x - box.min.x + 1};
}

/* Slices of the channels that there are, one for each name. Base pointers are
 * those of pixel (0, 0), which may lie outside of the buffer; rows overlay each
 * other. */
Imf::FrameBuffer
frame_buffer(const otx_openexr_picture &p, window w, std::vector<float> *row)
{
    const size_t pixel = 4 * sizeof(float);
    Imf::FrameBuffer frame;

    for (int c = 0; c < 4; ++c)
        if (p.channels[c] && !frame.findSlice(p.channels[c]))
            frame.insert(
                p.channels[c], Imf::Slice(
                                   Imf::FLOAT,
                                   reinterpret_cast<char *>(row->data() + c) -
                                       ptrdiff_t(pixel) * w.x_min,
                                   pixel, 0));
    return frame;
}

/* The same channel in several places, and the alpha of those that have none. */
void
complete_row(const otx_openexr_picture &p, std::vector<float> *row)
{
    for (int c = 1; c < 4; ++c)
    {
        int from = 0;

        while (from < c && p.channels[c] &&
               std::strcmp(p.channels[from], p.channels[c]) != 0)
            ++from;
        for (size_t i = 0; i < row->size(); i += 4)
            if (!p.channels[c])
                (*row)[i + size_t(c)] = 1.0f;
            else if (from < c)
                (*row)[i + size_t(c)] = (*row)[i + size_t(from)];
    }
}

void
read_channels(const otx_openexr_picture &p, otx_openexr_sink sink, void *user)
{
    Imf::MultiPartInputFile file(p.path, 0);
    Imf::InputPart part(file, p.part);
    const window w = window_of(part.header().dataWindow());
    std::vector<float> row(4 * size_t(w.width));

    part.setFrameBuffer(frame_buffer(p, w, &row));
    for (int32_t y = p.y_min; y <= p.y_max; ++y)
    {
        part.readPixels(y, y);
        complete_row(p, &row);
        sink(user, y, row.data(), w.x_min, w.width);
    }
}

/* OpenEXR's own reconstruction of chroma, and its weights from the header's
 * chromaticities. */
void
read_chroma(const otx_openexr_picture &p, otx_openexr_sink sink, void *user)
{
    Imf::RgbaInputFile file(p.path, 0);
    const window w = window_of(file.dataWindow());
    std::vector<Imf::Rgba> pixels(static_cast<size_t>(w.width));
    std::vector<float> row(4 * size_t(w.width));

    file.setFrameBuffer(pixels.data() - w.x_min, 1, 0);
    for (int32_t y = p.y_min; y <= p.y_max; ++y)
    {
        file.readPixels(y, y);
        for (size_t i = 0; i < pixels.size(); ++i)
        {
            row[4 * i] = pixels[i].r;
            row[4 * i + 1] = pixels[i].g;
            row[4 * i + 2] = pixels[i].b;
            row[4 * i + 3] = pixels[i].a;
        }
        sink(user, y, row.data(), w.x_min, w.width);
    }
}

/* What OpenEXR says may quote bytes of the file. */
void
keep_reason(const char *what, char reason[OTX_OPENEXR_REASON_BYTES])
{
    std::snprintf(reason, OTX_OPENEXR_REASON_BYTES, "%s", what);
    for (char *c = reason; *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

} // namespace

extern "C" otx_status
otx_openexr_read(
    const otx_openexr_picture *picture, otx_openexr_sink sink, void *user,
    char reason[OTX_OPENEXR_REASON_BYTES])
{
    reason[0] = '\0';
    try
    {
        if (picture->is_chroma)
            read_chroma(*picture, sink, user);
        else
            read_channels(*picture, sink, user);
        return OSDTEX_OK;
    }
    catch (const std::bad_alloc &)
    {
        return OSDTEX_ERROR_MEMORY;
    }
    catch (const std::exception &e)
    {
        keep_reason(e.what(), reason);
    }
    catch (...)
    {
        keep_reason("it does not say why", reason);
    }
    return OSDTEX_ERROR_FORMAT;
}
