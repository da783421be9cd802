# A runtime image that holds the daemon, its command line and their libraries. `docker build --target test .`
# runs every test but the browser's in an image of its own.
FROM debian:bookworm-slim AS build
WORKDIR /src
COPY scripts/install scripts/packages scripts/
RUN scripts/install build
COPY . .
RUN cmake --preset package \
 && cmake --build --preset package --target programs \
 && install -D --strip --target-directory /programs build/package/bin/fitgauged build/package/bin/fitgauge

FROM build AS test
RUN scripts/test --no-browser

FROM debian:bookworm-slim
WORKDIR /setup
COPY scripts/install scripts/packages scripts/
RUN scripts/install runtime \
 && rm -rf scripts /var/lib/apt/lists/* /var/log/*.log \
 && install -d -o 8286 -g 8286 -m 0750 /data
WORKDIR /data
COPY --from=build --chmod=0755 /programs/ /usr/local/bin/
ENV FITGAUGE_LISTEN=0.0.0.0:8286 FITGAUGE_DATA=/data
USER 8286:8286
VOLUME /data
EXPOSE 8286
HEALTHCHECK --interval=10s --timeout=3s --start-period=10s CMD ["/usr/local/bin/fitgauged", "--healthcheck"]
ENTRYPOINT ["/usr/local/bin/fitgauged"]
