// A client that openapi-typescript generates, compiled under `strict`: it stores a file in a folder and a value.
import createClient from "openapi-fetch";
import type { components, paths } from "./api.js";

type Record = components["schemas"]["Measurement"];

const client = createClient<paths>({ baseUrl: process.argv[2]! });

const stored = await client.PUT("/v1/files/{path}", {
  params: { path: { path: "nc_prog/generated/bore.h" } },
  body: "BEGIN PGM BORE MM\r\nEND PGM BORE MM\r\n",
  bodySerializer: (text: string) => text,
});
if (stored.response.status !== 201) throw new Error(`${stored.response.status}`);
const files = await client.GET("/v1/files", { params: { query: { prefix: "nc_prog/generated/" } } });
const path: string = files.data!.files[0]!.path;
if (path !== "TNC:\\nc_prog\\generated\\bore.h") throw new Error(path);

const posted = await client.POST("/v1/measurements", {
  body: { designation: "25 H7", measured_mm: "25.0215", part_id: "SN-1" },
  headers: { "Content-Type": "application/json" },
});
if (posted.error) throw new Error(posted.error.detail);
const record = posted.data as Record;
const verdict: "good" | "rework" | "reject" | "indeterminate" | undefined = record.verdict; // absent without limits
if (verdict !== "reject" || record.excess_um !== 0.5) throw new Error(JSON.stringify(record));

const refused = await client.POST("/v1/runs", {
  body: { program: "TNC:\\no.h", setup: { workpiece: { features: [{ type: "sphere", center_mm: [0, 0, 50], diameter_mm: 25 }] } } },
});
if (refused.error?.code !== "program.unknown") throw new Error(JSON.stringify(refused));
console.log("ok");
