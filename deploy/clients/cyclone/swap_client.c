/* A plain client on Eclipse Cyclone DDS, with nothing of the simulator but its IDL (compiled by idlc), that swaps a
 * profile of a running set: it writes the lever arm of a receiver's antenna to the topic of requests and waits for the
 * acknowledgement. The other four kinds of profile go the same way.
 *
 *   cyclone_swap_client X Y Z [--domain N] [--unit NAME] [--receiver N] [--at SECONDS]
 *
 * X, Y, Z: the antenna in the vehicle, m forward, right, down. Prints the acknowledgement. Exit code 0 when the swap is
 * in effect, 3 when it was rejected, superseded or not answered within 20 s.
 */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "control.h"
#include "dds/dds.h"
#include "profile.h"

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
    exit(2);
  }
  return entity;
}

/* Everybody who reads requests and writes acknowledgements is found one after the other, the logger perhaps before the
 * trajectory server: all are there when both have some and nobody has come for a second. */
static void wait_for_peers(dds_entity_t writer, dds_entity_t reader) {
  uint32_t seen = 0;
  int quiet = 0;
  for (int tries = 0; tries < 2000 && quiet < 100; tries++) {
    dds_publication_matched_status_t readers = {0};
    dds_subscription_matched_status_t writers = {0};
    dds_get_publication_matched_status(writer, &readers);
    dds_get_subscription_matched_status(reader, &writers);
    const uint32_t now = readers.current_count + writers.current_count;
    const bool some = readers.current_count > 0 && writers.current_count > 0;
    quiet = some && now == seen ? quiet + 1 : 0;
    seen = now;
    dds_sleepfor(DDS_MSECS(10));
  }
}

/* What became of request `id`; false when nothing came in time. */
static bool wait_for_ack(dds_entity_t reader, uint64_t id, inslab_v5_ProfileAck* found) {
  for (int tries = 0; tries < 2000; tries++) {
    void* samples[1] = {NULL};
    dds_sample_info_t info;
    while (dds_take(reader, samples, &info, 1, 1) > 0) {
      const inslab_v5_ProfileAck* ack = samples[0];
      const bool ours = info.valid_data && ack->request_id == id;
      if (ours) *found = *ack;
      dds_return_loan(reader, samples, 1);
      samples[0] = NULL;
      if (ours) return true;
    }
    dds_sleepfor(DDS_MSECS(10));
  }
  return false;
}

static const char kHelp[] =
    "Swaps the lever arm of a receiver's antenna in a running set, and waits for the acknowledgement.\n"
    "Usage: cyclone_swap_client X Y Z [OPTIONS]\n\n"
    "  X Y Z           the antenna in the vehicle, m forward, right, down\n"
    "  --domain N      DDS domain (default 0)\n"
    "  --unit NAME     the unit: the DDS partition (default none)\n"
    "  --receiver N    the receiver's number (default 0)\n"
    "  --at SECONDS    sim time of the swap (default: as soon as possible)\n"
    "  -h, --help      print this\n";

int main(int argc, char** argv) {
  uint32_t domain = 0;
  const char* unit = NULL;
  inslab_v5_InstallationProfile request;
  memset(&request, 0, sizeof(request)); /* no mounting angles, and no text is longer than this */
  request.target_kind = inslab_v5_SENSOR_GNSS;
  request.request.request_id = (uint64_t)dds_time();
  request.request.apply_at_ns = -1; /* as soon as possible */
  request.request.requested_at_ns = -1;
  strcpy(request.name, "from another vendor");
  for (int i = 1; i < argc; i++) {
    if (strcmp(argv[i], "--help") != 0 && strcmp(argv[i], "-h") != 0) continue;
    fputs(kHelp, stdout);
    return 0;
  }
  if (argc < 4) {
    fprintf(stderr, "cyclone_swap_client: expected X Y Z; --help says more\n");
    return 2;
  }
  for (int i = 0; i < 3; i++) request.lever_arm_v_m[i] = atof(argv[i + 1]);
  for (int i = 4; i + 1 < argc; i += 2) {
    if (strcmp(argv[i], "--domain") == 0) {
      domain = (uint32_t)atoi(argv[i + 1]);
    } else if (strcmp(argv[i], "--unit") == 0) {
      unit = argv[i + 1];
    } else if (strcmp(argv[i], "--receiver") == 0) {
      request.target_number = (uint32_t)atoi(argv[i + 1]);
    } else if (strcmp(argv[i], "--at") == 0) {
      request.request.apply_at_ns = (int64_t)(atof(argv[i + 1]) * 1e9);
    } else {
      fprintf(stderr, "cyclone_swap_client: unknown option %s; --help lists them\n", argv[i]);
      return 2;
    }
  }

  const dds_entity_t participant = checked(dds_create_participant(domain, NULL, NULL), "participant");
  dds_qos_t* group = dds_create_qos();
  if (unit != NULL) dds_qset_partition1(group, unit);
  const dds_entity_t subscriber = checked(dds_create_subscriber(participant, group, NULL), "subscriber");
  const dds_entity_t publisher = checked(dds_create_publisher(participant, group, NULL), "publisher");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
  const dds_entity_t request_topic = checked(
      dds_create_topic(participant, &inslab_v5_InstallationProfile_desc, "inslab/profile/installation", NULL, NULL),
      "inslab/profile/installation");
  const dds_entity_t ack_topic = checked(
      dds_create_topic(participant, &inslab_v5_ProfileAck_desc, "inslab/profile_ack", NULL, NULL), "inslab/profile_ack");
  const dds_entity_t reader = checked(dds_create_reader(subscriber, ack_topic, qos, NULL), "inslab/profile_ack");
  const dds_entity_t writer = checked(dds_create_writer(publisher, request_topic, qos, NULL), "request");
  wait_for_peers(writer, reader);

  inslab_v5_ProfileAck ack;
  int exit_code = 3;
  if (dds_write(writer, &request) != DDS_RETCODE_OK || !wait_for_ack(reader, request.request.request_id, &ack)) {
    fprintf(stderr, "no acknowledgement\n");
  } else if (ack.outcome == inslab_v5_ACK_APPLIED || ack.outcome == inslab_v5_ACK_UNCHANGED) {
    printf("in effect from %.9f s on, first sample %" PRIu64 "\n", (double)ack.apply_time_ns * 1e-9,
           ack.first_sequence);
    exit_code = 0;
  } else {
    printf("not in effect: %s: %s\n", ack.field, ack.reason);
  }
  dds_delete(participant);
  return exit_code;
}
