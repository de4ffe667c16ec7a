# Build: the wheel needs node for the front-end libraries; the build hook brings it.
FROM python:3.11-slim AS build
WORKDIR /source
COPY pyproject.toml README.md LICENSE ./
COPY backend backend
COPY frontend frontend
RUN python -m venv /opt/deltaq \
 && /opt/deltaq/bin/pip install --no-cache-dir --no-compile . \
 && /opt/deltaq/bin/python -m compileall -q /opt/deltaq/lib

# Compile the kernels once, so that the first simulation does not wait for a compiler.
ENV NUMBA_CACHE_DIR=/opt/kernels
RUN /opt/deltaq/bin/python -c "from deltaq.api.jobs import warm; warm({})"

FROM python:3.11-slim
RUN useradd --system --no-create-home --shell /usr/sbin/nologin deltaq
COPY --from=build /opt/deltaq /opt/deltaq
COPY --from=build --chown=deltaq /opt/kernels /opt/kernels
ENV NUMBA_CACHE_DIR=/opt/kernels PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1
USER deltaq
EXPOSE 8000
HEALTHCHECK --interval=30s --timeout=3s --start-period=20s CMD ["/opt/deltaq/bin/python", "-c", \
  "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/api/v1/health', timeout=2)"]
ENTRYPOINT ["/opt/deltaq/bin/deltaq", "serve", "--host", "0.0.0.0"]
