/* tensors.h -- arrays in a file, by name: the container of saved mappings.
 *
 * It is the safetensors layout, which Python reads with the package of that
 * name or with ten lines of NumPy (docs/formats-mapping.md):
 *
 *     8 bytes   length of the header, little-endian
 *     header    JSON: for each array its type, shape and place; and
 *               "__metadata__", an object of strings
 *     data      the arrays, little-endian, one after the other
 *
 * The same arrays give the same bytes. */
#ifndef OTX_FILE_TENSORS_H
#define OTX_FILE_TENSORS_H

#include "base/run.h"

typedef enum otx_tensor_type
{
    OTX_TENSOR_F64,
    OTX_TENSOR_I64,
    OTX_TENSOR_F32,
    OTX_TENSOR_I32,
    OTX_TENSOR_U8,
    OTX_TENSOR_TYPE_COUNT
} otx_tensor_type;

enum
{
    OTX_TENSORS_MAX = 64,              /* arrays of a file */
    OTX_TENSORS_HEADER_MAX = 16 << 20, /* bytes */
    OTX_TENSOR_NAME_BYTES = 64
};

typedef struct otx_tensor
{
    char name[OTX_TENSOR_NAME_BYTES];
    otx_tensor_type type;
    int64_t rows, columns; /* columns 0: a vector of `rows` */
    const void *data;      /* aligned to its type */
} otx_tensor;

typedef struct otx_tensors
{
    const char *about; /* JSON text: what the arrays are; NULL none */
    int32_t count;
    otx_tensor items[OTX_TENSORS_MAX];
} otx_tensors;

/* Adds an array, which is borrowed. Larger types must come first, so that all
 * lie aligned: in the order of otx_tensor_type. */
void otx_tensors_add(
    otx_tensors *tensors, const char *name, otx_tensor_type type, int64_t rows,
    int64_t columns, const void *data);

/* The array of a name, type and shape; NULL where there is none. `rows` and
 * `columns` of -1: any. */
const otx_tensor *otx_tensors_find(
    const otx_tensors *tensors, const char *name, otx_tensor_type type,
    int64_t rows, int64_t columns);

/* Writes to the file `temporary`, which is to be called `path`. IO, MEMORY. */
otx_status otx_tensors_write(
    otx_run *run, const otx_tensors *tensors, const char *temporary,
    const char *path);

/* Reads a file into run->arena. Nothing in it is trusted: an array lies within
 * the file, has the bytes that its shape says, and is aligned, or the file is
 * refused. FORMAT, LIMIT, IO, MEMORY. */
otx_status otx_tensors_read(otx_run *run, const char *path, otx_tensors *out);

/* The same of bytes in memory, into which the arrays point; `bytes` is aligned
 * to 64 but for its first 8 + header bytes, which are copied. */
otx_status otx_tensors_parse(
    otx_run *run, const char *path, const void *bytes, size_t size,
    otx_tensors *out);

#endif
