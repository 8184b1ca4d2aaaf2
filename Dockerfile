# Builds sites without installing anything else:
#
#   docker build -t shapeviz-report .
#   docker run --rm -v "$PWD:/work" shapeviz-report build shapes/ -o site/ --cache .shapeviz-cache
#
# Add `--user "$(id -u):$(id -g)"` on Linux, so that the files are yours.
FROM python:3.12-slim-bookworm

COPY . /source
# What is compiled on the first use is kept in the image.
RUN pip install --no-cache-dir --constraint /source/constraints.txt "/source[parquet]" \
    && rm -rf /source \
    && python -W ignore -c "import umap"

ENV HOME=/tmp
WORKDIR /work
ENTRYPOINT ["shapeviz-report"]
CMD ["--help"]
