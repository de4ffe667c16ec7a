# The service with its kernels compiled. It runs without root and on read-only files; /cache is all that it writes to:
#   docker run --read-only --tmpfs /cache -p 8000:8000 deltaq
# `.ci/prove-dockerfile` carries out every line of this file in a bare Debian.
# The bases are named by their tags. Whoever builds the same image again and again pins their content as well, by the digest
# that his registry tells: docker build --build-arg BASE=python@sha256:…
ARG BASE=python:3.11-slim-bookworm
FROM ${BASE} AS build
WORKDIR /source
COPY pyproject.toml README.md LICENSE ./
COPY backend backend
COPY frontend frontend
# Each package is the one whose hash stands in the checkout, those that build ours included. The libraries of the page come
# from npm by the hashes of its lockfile.
RUN python -m venv /opt/build \
 && /opt/build/bin/pip install --no-cache-dir --require-hashes --requirement backend/constraints-build.txt \
 && /opt/build/bin/pip wheel --no-cache-dir --no-deps --no-build-isolation --wheel-dir /opt/wheel . \
 && python -m venv /opt/deltaq \
 && /opt/deltaq/bin/pip install --no-cache-dir --require-hashes --requirement backend/constraints.txt \
 && /opt/deltaq/bin/pip install --no-cache-dir --no-deps --no-index /opt/wheel/*.whl \
 && rm -rf /opt/deltaq/lib/python3.11/site-packages/pip*

# Compiled once, so that the first simulation does not wait for a compiler.
ENV NUMBA_CACHE_DIR=/opt/kernels
RUN /opt/deltaq/bin/deltaq compile

FROM ${BASE}
RUN useradd --system --no-create-home --shell /usr/sbin/nologin deltaq \
 && install --directory --owner deltaq /cache
COPY --from=build /opt/deltaq /opt/deltaq
COPY --from=build /opt/kernels /opt/kernels
ENV NUMBA_CACHE_DIR=/cache/kernels DELTAQ_CACHE_FOLDER=/cache/answers TMPDIR=/cache
ENV PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1
USER deltaq
EXPOSE 8000
HEALTHCHECK --interval=30s --timeout=3s --start-period=20s CMD ["/opt/deltaq/bin/python", "-c", \
  "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/api/v1/health', timeout=2)"]
# Numba wants to be able to write where it reads kernels.
ENTRYPOINT ["/bin/sh", "-c", "cp -r /opt/kernels /cache && exec /opt/deltaq/bin/deltaq serve --host 0.0.0.0 \"$@\"", "deltaq"]
