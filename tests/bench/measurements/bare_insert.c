/* bare_insert DATABASE ROWS TIMES: the peer of the bulk benchmark, what a plain C program does: one
 * prepared statement, stepped once a row, all rows in one transaction; and that so many times. Prints
 * the seconds of all of them but the first, each from BEGIN to the end of COMMIT.
 *
 * The same as in the service: the database is one the service made, so the columns, CHECKs, indexes and
 * triggers are its own; the rows fill the same columns with values of the same size, 32 bytes of hash
 * among them; WAL, synchronous=FULL, the checkpoint interval, the page cache, foreign keys; the commit
 * waits for the disk.
 * Not the same, to the advantage of this program: no HTTP, no JSON in either direction, no check of
 * fields, no limits, no verdict, no hash is computed (its bytes are zero), no answer is rendered; the
 * texts but one are constants in memory. To the service's: it writes many rows a statement, reads and
 * renders on a second processor while the first inserts, and has switched SQLite's memory statistics
 * off, where this program takes SQLite as it comes. */

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static sqlite3 *database;

static void require(int succeeded) {
  if (succeeded) return;
  fprintf(stderr, "bare_insert: %s\n", sqlite3_errmsg(database));
  exit(1);
}

static void run(const char *sql) {
  require(sqlite3_exec(database, sql, NULL, NULL, NULL) == SQLITE_OK);
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static void insert(sqlite3_stmt *statement, int row) {
  static const char hash[32];
  static const char *const texts[] = {"bore-A", "WO-17", "OP20", "M3", "42", "G-07"};
  char part[32];
  const long long at = 1795000000000000000LL;
  const long long integers[] = {1, at, at, 25000000, 1, 21000, 0, 18000000, 30000000, 1, 1};
  int column = 1;
  for (size_t i = 0; i < sizeof integers / sizeof *integers; ++i)
    sqlite3_bind_int64(statement, column++, integers[i]);
  sqlite3_bind_text(statement, column++, "H7", 2, SQLITE_STATIC);
  sqlite3_bind_int64(statement, column++, 25000000 + row % 21000);
  sqlite3_bind_int64(statement, column++, 1);
  sqlite3_bind_int64(statement, column++, 1);
  snprintf(part, sizeof part, "SN-%07d", row);
  sqlite3_bind_text(statement, column++, part, -1, SQLITE_STATIC);
  for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i)
    sqlite3_bind_text(statement, column++, texts[i], -1, SQLITE_STATIC);
  sqlite3_bind_blob(statement, column, hash, sizeof hash, SQLITE_STATIC);
  require(sqlite3_step(statement) == SQLITE_DONE);
  sqlite3_reset(statement);
}

int main(int argc, char **argv) {
  sqlite3_stmt *statement;
  if (argc != 4) return fprintf(stderr, "bare_insert DATABASE ROWS TIMES\n"), 2;
  require(sqlite3_open_v2(argv[1], &database, SQLITE_OPEN_READWRITE, NULL) == SQLITE_OK);
  run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 4000;"
      "PRAGMA cache_size = -16000; PRAGMA foreign_keys = ON");
  require(sqlite3_prepare_v3(
              database,
              "INSERT INTO measurements (source, measured_at, received_at, nominal_nm, feature, "
              "upper_deviation_nm, lower_deviation_nm, size_over_nm, size_up_to_nm, basis, "
              "table_revision, tolerance_class, measured_nm, verdict, rule, part_id, characteristic, "
              "work_order, operation, machine, operator, gauge, hash) "
              "VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
              -1, SQLITE_PREPARE_PERSISTENT, &statement, NULL) == SQLITE_OK);
  double seconds = 0;
  for (int time = 0; time < atoi(argv[3]); ++time) {
    const double start = now();
    run("BEGIN IMMEDIATE");
    for (int row = 0; row < atoi(argv[2]); ++row) insert(statement, row);
    run("COMMIT");
    if (time > 0) seconds += now() - start;
  }
  printf("%.6f\n", seconds);
  sqlite3_finalize(statement);
  sqlite3_close(database);
  return 0;
}
