// Particles from anywhere, transposed into registers and back.

// NOLINTBEGIN

struct FourVectors
{
  Vector x, y, z, w;
};

inline End endOf(const FourVectors& v)
{
  return { v.x, v.y, v.z };
}

#if defined(__AVX512F__)

inline __m512 fourRecords(const Record* records, const int* index)
{
  __m512 r = _mm512_castps128_ps512(_mm_load_ps(&records[index[0]].x));
  r = _mm512_insertf32x4(r, _mm_load_ps(&records[index[4]].x), 1);
  r = _mm512_insertf32x4(r, _mm_load_ps(&records[index[8]].x), 2);
  return _mm512_insertf32x4(r, _mm_load_ps(&records[index[12]].x), 3);
}

inline void storeFour(Record* records, const int* index, __m512 r)
{
  _mm_store_ps(&records[index[0]].x, _mm512_castps512_ps128(r));
  _mm_store_ps(&records[index[4]].x, _mm512_extractf32x4_ps(r, 1));
  _mm_store_ps(&records[index[8]].x, _mm512_extractf32x4_ps(r, 2));
  _mm_store_ps(&records[index[12]].x, _mm512_extractf32x4_ps(r, 3));
}

inline void transpose(__m512& r0, __m512& r1, __m512& r2, __m512& r3)
{
  const __m512d t0 = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1));
  const __m512d t1 = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
  const __m512d t2 = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3));
  const __m512d t3 = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
  r0 = _mm512_castpd_ps(_mm512_unpacklo_pd(t0, t2));
  r1 = _mm512_castpd_ps(_mm512_unpackhi_pd(t0, t2));
  r2 = _mm512_castpd_ps(_mm512_unpacklo_pd(t1, t3));
  r3 = _mm512_castpd_ps(_mm512_unpackhi_pd(t1, t3));
}

using Row = __m512;

#elif defined(__AVX2__)

inline __m256 fourRecords(const Record* records, const int* index)
{
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&records[index[0]].x)),
                              _mm_load_ps(&records[index[4]].x), 1);
}

inline void storeFour(Record* records, const int* index, __m256 r)
{
  _mm_store_ps(&records[index[0]].x, _mm256_castps256_ps128(r));
  _mm_store_ps(&records[index[4]].x, _mm256_extractf128_ps(r, 1));
}

inline void transpose(__m256& r0, __m256& r1, __m256& r2, __m256& r3)
{
  const __m256d t0 = _mm256_castps_pd(_mm256_unpacklo_ps(r0, r1));
  const __m256d t1 = _mm256_castps_pd(_mm256_unpackhi_ps(r0, r1));
  const __m256d t2 = _mm256_castps_pd(_mm256_unpacklo_ps(r2, r3));
  const __m256d t3 = _mm256_castps_pd(_mm256_unpackhi_ps(r2, r3));
  r0 = _mm256_castpd_ps(_mm256_unpacklo_pd(t0, t2));
  r1 = _mm256_castpd_ps(_mm256_unpackhi_pd(t0, t2));
  r2 = _mm256_castpd_ps(_mm256_unpacklo_pd(t1, t3));
  r3 = _mm256_castpd_ps(_mm256_unpackhi_pd(t1, t3));
}

using Row = __m256;

#elif defined(__SSE2__)

inline __m128 fourRecords(const Record* records, const int* index)
{
  return _mm_load_ps(&records[index[0]].x);
}

inline void storeFour(Record* records, const int* index, __m128 r)
{
  _mm_store_ps(&records[index[0]].x, r);
}

inline void transpose(__m128& r0, __m128& r1, __m128& r2, __m128& r3)
{
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
}

using Row = __m128;

#endif

#if defined(__SSE2__)

inline FourVectors loadRecords(const Record* records, const int* index)
{
  Row r0 = fourRecords(records, index);
  Row r1 = fourRecords(records, index + 1);
  Row r2 = fourRecords(records, index + 2);
  Row r3 = fourRecords(records, index + 3);
  transpose(r0, r1, r2, r3);
  return { (Vector)r0, (Vector)r1, (Vector)r2, (Vector)r3 };
}

inline void storeRecords(Record* records, const int* index, const End& end, Vector w)
{
  Row r0 = (Row)end.x;
  Row r1 = (Row)end.y;
  Row r2 = (Row)end.z;
  Row r3 = (Row)w;
  transpose(r0, r1, r2, r3);
  storeFour(records, index, r0);
  storeFour(records, index + 1, r1);
  storeFour(records, index + 2, r2);
  storeFour(records, index + 3, r3);
}

#else

inline FourVectors loadRecords(const Record* records, const int* index)
{
  FourVectors v;
  for (int i = 0; i < WIDTH; ++i)
  {
    v.x[i] = records[index[i]].x;
    v.y[i] = records[index[i]].y;
    v.z[i] = records[index[i]].z;
    v.w[i] = records[index[i]].w;
  }
  return v;
}

inline void storeRecords(Record* records, const int* index, const End& end, Vector w)
{
  for (int i = 0; i < WIDTH; ++i)
  {
    records[index[i]] = { end.x[i], end.y[i], end.z[i], w[i] };
  }
}

#endif

// NOLINTEND
